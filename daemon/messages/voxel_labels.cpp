#include "daemon/messages/voxel_labels.h"

#include <bit>

namespace mocap {
namespace {

constexpr double kLabelledMm = 150;

struct PosedPart {
  PosedCapsule capsule;
  BodyPart part;
};

std::vector<PosedPart> PosedPartsOf(std::span<const BodyInPlace> bodies) {
  std::vector<PosedPart> parts;
  std::vector<PosedCapsule> posed;
  for (const auto& [body, pose] : bodies) {
    body.PoseShape(body.PostureAt(pose), posed);
    for (std::size_t i = 0; i < posed.size(); ++i)
      parts.push_back({posed[i], body.shape()[i].part});
  }
  return parts;
}

std::int8_t LabelOf(const Vector3& p_W, const std::vector<PosedPart>& parts) {
  std::int8_t label = -1;
  double nearest_mm = kLabelledMm;
  for (const auto& [capsule, part] : parts) {
    const double far_mm = capsule.reach_mm + nearest_mm;
    if (far_mm < 0 || (capsule.middle_W - p_W).squaredNorm() > far_mm * far_mm) continue;
    const double outside_mm = capsule.DistanceTo(p_W).outside_mm;
    if (outside_mm >= nearest_mm) continue;
    nearest_mm = outside_mm;
    label = static_cast<std::int8_t>(part);
  }
  return label;
}

}  // namespace

void LabelForViewers(const VoxelGrid& grid, std::span<const BodyInPlace> bodies,
                     std::vector<std::int8_t>& labels) {
  const std::vector<PosedPart> parts = PosedPartsOf(bodies);
  labels.clear();
  for (int k = 0; k < grid.size().z(); ++k) {
    for (int j = 0; j < grid.size().y(); ++j) {
      for (int word = 0; word < grid.words_per_row(); ++word) {
        for (std::uint64_t bits = grid.row(j, k)[word]; bits != 0; bits &= bits - 1) {
          const int i = word * 64 + std::countr_zero(bits);
          labels.push_back(LabelOf(grid.CenterOf(i, j, k), parts));
        }
      }
    }
  }
}

}  // namespace mocap
