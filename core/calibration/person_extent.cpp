#include "core/calibration/person_extent.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/calibration/view_agreement.h"
#include "core/quantile.h"

namespace mocap {
namespace {

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

/// What all cameras share reaches below the feet, by this much of a height: cameras above look
/// under them. By right floors it was 18 to 107 mm; docs/experiments/cameras.md.
constexpr double kBelowFeet = 0.03;

using Polygon = std::vector<Vector2>;

/// Cuts off what lies on the negative side of a plane (Sutherland and Hodgman, 1974).
Polygon Clipped(const Polygon& polygon, double z, const Vector3& eye_W, const Vector3& normal_W) {
  const auto above = [&](const Vector2& p) {
    return normal_W.dot(Vector3(p.x(), p.y(), z) - eye_W);
  };
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2& a = polygon[i];
    const Vector2& b = polygon[(i + 1) % polygon.size()];
    const double above_a = above(a), above_b = above(b);
    if (above_a >= 0) kept.push_back(a);
    if ((above_a >= 0) != (above_b >= 0))
      kept.push_back(a + above_a / (above_a - above_b) * (b - a));
  }
  return kept;
}

/// Whether all cones share a point at this height, within `far` of a place.
bool Share(const std::vector<SeenCone>& cones, const Vector3& place_W, double far, double z) {
  Polygon shared;
  for (const Vector2& corner : {Vector2(-1, -1), Vector2(1, -1), Vector2(1, 1), Vector2(-1, 1)})
    shared.push_back(place_W.head<2>() + far * corner);
  for (const SeenCone& cone : cones) {
    const Vector3 middle = MiddleOf(cone);
    for (std::size_t i = 0; i < cone.rays_W.size() && !shared.empty(); ++i) {
      Vector3 normal = cone.rays_W[i].cross(cone.rays_W[(i + 1) % cone.rays_W.size()]);
      if (normal.dot(middle) < 0) normal = -normal;
      shared = Clipped(shared, z, cone.eye_W, normal);
    }
  }
  return !shared.empty();
}

/// The end of what all cones share, upwards or downwards from a height at which they share points.
double EndOf(const std::vector<SeenCone>& cones, const Vector3& place_W, double far) {
  double inside = 0, outside = far;
  constexpr int kHalvings = 14;
  for (int i = 0; i < kHalvings; ++i) {
    const double half = (inside + outside) / 2;
    (Share(cones, place_W, std::abs(far), place_W.z() + half) ? inside : outside) = half;
  }
  return place_W.z() + inside;
}

}  // namespace

PersonExtent MeasureExtent(std::span<const CameraCalibration> cameras,
                           std::span<const SeenMoment> moments, std::span<const std::size_t> of) {
  std::vector<double> lows, highs;
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
    double far = 0;
    for (const SeenCone& cone : cones) far = std::max(far, (cone.eye_W - place_W).norm());
    if (!Share(cones, place_W, far, place_W.z())) continue;
    const double lowest = EndOf(cones, place_W, -far), highest = EndOf(cones, place_W, far);
    if (FarthestFrom(place_W, cones) > kMostApart * (highest - lowest)) continue;
    lows.push_back(lowest + kBelowFeet * (highest - lowest));
    highs.push_back(highest);
  }
  if (lows.empty()) return {};
  return {static_cast<int>(lows.size()), MedianOf(lows), MedianOf(highs)};
}

}  // namespace mocap
