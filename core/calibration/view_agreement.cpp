#include "core/calibration/view_agreement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mocap {
namespace {

/// A wider range of planes surrounds the baseline: the person stands between the cameras.
constexpr double kWidestRange_rad = 0.8 * std::numbers::pi;

struct Range {
  double low = 0, high = 0;
  double length() const { return high - low; }
};

/// Range of the planes about an axis that contain the rays.
/// @param zero, quarter  directions across the axis at 0 and 90 degrees.
Range RangeOf(const SeenCone& cone, const Vector3& zero, const Vector3& quarter) {
  Range range{HUGE_VAL, -HUGE_VAL};
  for (const Vector3& ray : cone.rays_W) {
    const double angle = std::atan2(ray.dot(quarter), ray.dot(zero));
    range.low = std::min(range.low, angle);
    range.high = std::max(range.high, angle);
  }
  return range;
}

}  // namespace

SeenCone ConeOf(const SeenShape& shape, const Lens& lens, const RigidTransform& X_CW) {
  const RigidTransform X_WC = X_CW.Inverse();
  SeenCone cone{.eye_W = X_WC.p, .rays_W = {}, .is_cut = shape.is_cut};
  for (const Vector2& corner : shape.rim_px) {
    if (const auto n = NormalizedFromPixel(lens, corner))
      cone.rays_W.emplace_back(X_WC.R * n->homogeneous());
  }
  return cone;
}

std::optional<ViewAgreement> AgreementOf(const SeenCone& a, const SeenCone& b) {
  if (a.rays_W.empty() || b.rays_W.empty() || (a.is_cut && b.is_cut)) return {};
  const Vector3 baseline = b.eye_W - a.eye_W;
  if (baseline.isZero()) return {};
  const Vector3 axis = baseline.normalized();
  Vector3 middle = Vector3::Zero();
  for (const Vector3& ray : a.rays_W) middle += ray;
  const Vector3 across = middle - middle.dot(axis) * axis;
  if (across.isZero()) return {};
  const Vector3 zero = across.normalized();
  const Vector3 quarter = axis.cross(zero);
  const Range in_a = RangeOf(a, zero, quarter), in_b = RangeOf(b, zero, quarter);
  if (in_a.length() > kWidestRange_rad || in_b.length() > kWidestRange_rad) return {};
  const double shared =
      std::max(0.0, std::min(in_a.high, in_b.high) - std::max(in_a.low, in_b.low));
  const double smaller = std::min(in_a.length(), in_b.length());
  const double all = a.is_cut   ? in_a.length()
                     : b.is_cut ? in_b.length()
                                : in_a.length() + in_b.length() - shared;
  if (smaller <= 0) return {};
  return ViewAgreement{.overlap = shared / all, .contained = shared / smaller};
}

}  // namespace mocap
