#include "core/people/witnesses.h"

#include <algorithm>

#include "core/people/posed_person.h"

namespace mocap {
namespace {

// With few cameras, all but one.
constexpr int kWitnesses = 4;

}  // namespace

int WitnessesWanted(std::size_t cameras) {
  return std::min(kWitnesses, std::max(static_cast<int>(cameras) - 1, 2));
}

bool IsCovered(const Eigen::AlignedBox3d& flesh_W, double beside_mm,
               std::span<const CameraEye> eyes) {
  Eigen::AlignedBox3d box_W = DownToFloor(flesh_W, 0);
  const Vector3 beside(beside_mm, beside_mm, 0);
  box_W = {box_W.min() - beside, box_W.max() + beside};
  const auto seeing =
      std::ranges::count_if(eyes, [&](const CameraEye& eye) { return eye.SeesAllWithin(box_W); });
  return seeing >= WitnessesWanted(eyes.size());
}

}  // namespace mocap
