#include "core/tracking/head_score.h"

#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

// Flesh just beyond the crust tells a shoulder or a hip from a head, which stands alone on its
// neck.
constexpr double kSurroundings = 1.45;
// Finer than this tells no more of a head.
constexpr double kFinestMm = 25;

}  // namespace

HeadScore::HeadScore(const VoxelCloud& cloud, const HeadCrust& crust)
    : stride_(std::max(1, static_cast<int>(kFinestMm / cloud.voxel_mm()))),
      margin_(static_cast<int>(std::ceil(kSurroundings * crust.outer_mm / cloud.voxel_mm()))),
      size_(cloud.size_cells()) {
  kinds_.assign((size_.array() + 2 * margin_).cast<std::size_t>().prod(), kEmpty);
  for (const Voxel& voxel : cloud.voxels()) {
    kinds_[SlotOf(voxel.cell)] = voxel.surface ? kSurface : kInside;
  }
  const std::ptrdiff_t center = SlotOf(Eigen::Vector3i::Zero());
  const int reach = margin_ / stride_ * stride_;
  for (int dz = -reach; dz <= reach; dz += stride_) {
    for (int dy = -reach; dy <= reach; dy += stride_) {
      for (int dx = -reach; dx <= reach; dx += stride_) {
        const Eigen::Vector3i step(dx, dy, dz);
        const double distance_mm = step.cast<double>().norm() * cloud.voxel_mm();
        if (distance_mm < crust.inner_mm || distance_mm >= kSurroundings * crust.outer_mm) continue;
        (distance_mm <= crust.outer_mm ? crust_ : around_).push_back(SlotOf(step) - center);
      }
    }
  }
}

std::ptrdiff_t HeadScore::SlotOf(const Eigen::Vector3i& cell) const {
  const auto at = (cell.array() + margin_).cast<std::ptrdiff_t>();
  return (at.z() * (size_.y() + 2 * margin_) + at.y()) * (size_.x() + 2 * margin_) + at.x();
}

bool HeadScore::IsOnLattice(const Eigen::Vector3i& cell) const {
  return cell.x() % stride_ == 0 && cell.y() % stride_ == 0 && cell.z() % stride_ == 0;
}

std::optional<double> HeadScore::Above(double least, const Eigen::Vector3i& cell) const {
  const Kind* center = kinds_.data() + SlotOf(cell);
  const auto share = [&](const std::vector<std::ptrdiff_t>& steps, Kind kind) {
    const auto count =
        std::ranges::count_if(steps, [&](std::ptrdiff_t step) { return center[step] >= kind; });
    return static_cast<double>(count) / static_cast<double>(steps.size());
  };
  const double crust = share(crust_, kSurface);
  if (crust <= least) return std::nullopt;
  const double score = crust - share(around_, kInside);
  return score > least ? std::optional(score) : std::nullopt;
}

}  // namespace mocap
