#include "core/calibration/person_extent.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/calibration/view_agreement.h"
#include "core/quantile.h"

namespace mocap {
namespace {

/// Steeper rays tell little about heights.
const double kSteepest = std::tan(55 * std::numbers::pi / 180);

/// Several people beside each other, and somebody who lies, are wider than this, in heights.
constexpr double kWidest = 1.2;

bool IsUpright(const SeenShape& shape) {
  Eigen::AlignedBox2d box;
  for (const Vector2& corner : shape.rim_px) box.extend(corner);
  return box.sizes().x() <= kWidest * box.sizes().y();
}

/// The point nearest to the middle rays of all cones.
Vector3 PlaceOf(const std::vector<SeenCone>& cones) {
  Matrix3 A = Matrix3::Zero();
  Vector3 b = Vector3::Zero();
  for (const SeenCone& cone : cones) {
    Vector3 middle = Vector3::Zero();
    for (const Vector3& ray : cone.rays_W) middle += ray.normalized();
    const Vector3 axis = middle.normalized();
    const Matrix3 across = Matrix3::Identity() - axis * axis.transpose();
    A += across;
    b += across * cone.eye_W;
  }
  return A.inverse() * b;
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
  Heights medians;
  for (const SeenMoment& moment : moments) {
    std::vector<SeenCone> cones;
    bool is_upright = true;
    for (const std::size_t c : of) {
      if (!moment[c] || moment[c]->rim_px.empty() || moment[c]->is_cut) continue;
      is_upright &= IsUpright(*moment[c]);
      cones.push_back(ConeOf(*moment[c], cameras[c].lens, moment[c]->X_CW));
    }
    if (cones.size() < 2 || !is_upright) continue;
    const Vector3 place_W = PlaceOf(cones);
    if (!place_W.allFinite()) continue;
    Heights heights;
    for (const SeenCone& cone : cones) AddHeights(cone, place_W, heights);
    if (heights.lowest.empty()) continue;
    medians.lowest.push_back(QuantileOf(heights.lowest, 1 - kFarthest));
    medians.highest.push_back(QuantileOf(heights.highest, kFarthest));
  }
  if (medians.lowest.empty()) return {};
  return {static_cast<int>(medians.lowest.size()), MedianOf(medians.lowest),
          MedianOf(medians.highest)};
}

}  // namespace mocap
