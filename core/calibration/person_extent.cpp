#include "core/calibration/person_extent.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/calibration/view_agreement.h"
#include "core/degrees.h"
#include "core/quantile.h"

namespace mocap {
namespace {

/// Steeper rays tell little about heights.
const double kSteepest = std::tan(55 / kDegreesPerRad);

/// Several people beside each other, and somebody who lies, are wider than this, in heights.
constexpr double kWidest = 1.2;

/// The middle rays of several people pass each other farther away than this, in heights.
constexpr double kMostApart = 0.3;

bool IsUpright(const SeenShape& shape) {
  Eigen::AlignedBox2d box;
  for (const Vector2& corner : shape.rim_px) box.extend(corner);
  return box.sizes().x() <= kWidest * box.sizes().y();
}

/// The ray in the middle of a cone, of unit length.
Vector3 MiddleOf(const SeenCone& cone) {
  Vector3 middle = Vector3::Zero();
  for (const Vector3& ray : cone.rays_W) middle += ray.normalized();
  return middle.normalized();
}

/// The point nearest to the middle rays of all cones.
Vector3 PlaceOf(const std::vector<SeenCone>& cones) {
  Matrix3 A = Matrix3::Zero();
  Vector3 b = Vector3::Zero();
  for (const SeenCone& cone : cones) {
    const Vector3 axis = MiddleOf(cone);
    const Matrix3 across = Matrix3::Identity() - axis * axis.transpose();
    A += across;
    b += across * cone.eye_W;
  }
  return A.inverse() * b;
}

/// How far the middle rays pass a place at most.
double FarthestFrom(const Vector3& place_W, const std::vector<SeenCone>& cones) {
  double farthest = 0;
  for (const SeenCone& cone : cones)
    farthest = std::max(farthest, MiddleOf(cone).cross(place_W - cone.eye_W).norm());
  return farthest;
}

/// A foot or hand that is held towards a camera seems lower or higher than it is. Cameras from
/// aside see it where it is.
constexpr double kFarthest = 0.25;

struct Heights {
  std::vector<double> lowest, highest;
};

/// Adds the heights of a cone's lowest and highest ray where they pass the person.
void AddHeights(const SeenCone& cone, const Vector3& place_W, Heights& heights) {
  const double away = (place_W - cone.eye_W).head<2>().norm();
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Vector3& ray : cone.rays_W) {
    const double slope = ray.z() / ray.head<2>().norm();
    if (!(std::abs(slope) < kSteepest)) return;
    low = std::min(low, cone.eye_W.z() + slope * away);
    high = std::max(high, cone.eye_W.z() + slope * away);
  }
  heights.lowest.push_back(low);
  heights.highest.push_back(high);
}

}  // namespace

PersonExtent MeasureExtent(std::span<const CameraCalibration> cameras,
                           std::span<const SeenMoment> moments, std::span<const std::size_t> of) {
  Heights all;
  for (const SeenMoment& moment : moments) {
    std::vector<SeenCone> cones;
    bool is_upright = true;
    for (const std::size_t c : of) {
      if (!moment[c] || moment[c]->height_share < kLeastPersonShare || moment[c]->is_cut) continue;
      is_upright &= IsUpright(*moment[c]);
      SeenCone cone = ConeOf(*moment[c], cameras[c].lens, moment[c]->X_CW);
      if (!cone.rays_W.empty()) cones.push_back(std::move(cone));
    }
    if (cones.size() < 2 || !is_upright) continue;
    const Vector3 place_W = PlaceOf(cones);
    if (!place_W.allFinite()) continue;
    Heights heights;
    for (const SeenCone& cone : cones) AddHeights(cone, place_W, heights);
    if (heights.lowest.empty()) continue;
    const double lowest = QuantileOf(heights.lowest, 1 - kFarthest);
    const double highest = QuantileOf(heights.highest, kFarthest);
    if (FarthestFrom(place_W, cones) > kMostApart * (highest - lowest)) continue;
    all.lowest.push_back(lowest);
    all.highest.push_back(highest);
  }
  if (all.lowest.empty()) return {};
  return {static_cast<int>(all.lowest.size()), MedianOf(all.lowest), MedianOf(all.highest)};
}

}  // namespace mocap
