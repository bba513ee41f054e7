// A simulated body as capsules: how near two people come to each other.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "core/geometry.h"
#include "drivers/virtual_studio/people/skeleton.h"

namespace mocap::simulation {

struct Capsule {
  Vector3 from_W, to_W;
  double radius_mm;
  bool is_right_hand = false;  ///< Or the forearm before it.
};

/// Slim: flesh reaches to the capsules or beyond.
inline std::vector<Capsule> CapsulesOf(const Anthropometry& body, const BonePoses& bones) {
  const TruePoints p = PointsOf(body, bones);
  const auto at = [&p](TruthPoint point, int side = 0) {
    return p[static_cast<int>(point) + side];
  };
  const double h = body.stature_mm;
  using enum TruthPoint;
  std::vector<Capsule> capsules = {{at(kPelvis), at(kNeck), 0.065 * h},
                                   {at(TruthPoint::kNeck), at(TruthPoint::kHead), 0.04 * h}};
  for (const int side : {kLeft, kRight}) {
    const bool right = side == kRight;
    capsules.push_back({at(kShoulderL, side), at(kElbowL, side), 0.02 * h});
    capsules.push_back({at(kElbowL, side), at(kWristL, side), 0.015 * h, right});
    capsules.push_back({at(kWristL, side), at(kFingertipsL, side), 0.01 * h, right});
    capsules.push_back({at(kHipL, side), at(kKneeL, side), 0.035 * h});
    capsules.push_back({at(kKneeL, side), at(kAnkleL, side), 0.025 * h});
    capsules.push_back({at(kAnkleL, side), at(kToeL, side), 0.02 * h});
  }
  return capsules;
}

/// Distance of two segments (Ericson, Real-Time Collision Detection, 5.1.9).
inline double SegmentDistance(const Capsule& a, const Capsule& b) {
  const Vector3 u = a.to_W - a.from_W, v = b.to_W - b.from_W, w = a.from_W - b.from_W;
  const double uu = u.dot(u), vv = v.dot(v), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double denominator = uu * vv - uv * uv;
  double s = denominator > 1e-9 ? std::clamp((uv * vw - uw * vv) / denominator, 0.0, 1.0) : 0;
  const double t = std::clamp((uv * s + vw) / vv, 0.0, 1.0);
  s = std::clamp((uv * t - uw) / uu, 0.0, 1.0);
  return (w + s * u - t * v).norm();
}

/// The gap between two bodies; negative where they are in each other. Right hands do not count
/// with each other.
inline double GapBetween(const std::vector<Capsule>& a, const std::vector<Capsule>& b) {
  double gap = std::numeric_limits<double>::max();
  for (const Capsule& i : a)
    for (const Capsule& j : b) {
      if (i.is_right_hand && j.is_right_hand) continue;
      gap = std::min(gap, SegmentDistance(i, j) - i.radius_mm - j.radius_mm);
    }
  return gap;
}

}  // namespace mocap::simulation
