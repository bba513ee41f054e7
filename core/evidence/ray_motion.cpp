#include "core/evidence/ray_motion.h"

#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

// A trigger is more exact. In this time a hand at 3 m/s moves by 3 mm, much less than rays err.
constexpr double kAtOnce_s = 0.001;
// What passes every part at this distance shows something else.
constexpr double kGrazes_mm = 150;
// A ray reaches from its camera to here, beyond anybody.
constexpr double kLongest_mm = 20000;

}  // namespace

void RayMotion::BringToSet(const PersonMotion& motion, std::vector<BoundingEdge>& edges,
                           std::vector<Outline>& borders) {
  bool is_posed = false;
  for (Outline& outline : borders) {
    if (outline.empty() || std::abs(outline.front().after_s) < kAtOnce_s) continue;
    if (!is_posed) at_set_.Set(motion.body, motion.pose_after(0));
    is_posed = true;
    const double after_s = outline.front().after_s;
    seen_.Set(motion.body, motion.pose_after(after_s));
    MoveEdges(after_s, edges);
    MoveRays(outline);
  }
}

void RayMotion::MoveEdges(double after_s, std::vector<BoundingEdge>& edges) {
  segments_.clear();
  places_.clear();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (edges[i].after_s != after_s) continue;
    segments_.push_back(edges[i]);
    places_.push_back(i);
  }
  const std::vector<SegmentMatch>& matches = Match();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Vector3 moved_W = MotionOf(matches[i]);
    edges[places_[i]].from_W += moved_W;
    edges[places_[i]].to_W += moved_W;
  }
}

// The rays of a camera keep their eye.
void RayMotion::MoveRays(Outline& outline) {
  segments_.clear();
  places_.clear();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const GrazingRay& ray = outline[i];
    if (ray.empty()) continue;
    segments_.push_back({ray.eye_W, ray.eye_W + kLongest_mm * ray.direction_W, ray.outward_W});
    places_.push_back(i);
  }
  const std::vector<SegmentMatch>& matches = Match();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (matches[i].capsule < 0) continue;
    GrazingRay& ray = outline[places_[i]];
    const Vector3 grazed_W = matches[i].distance.segment_W + MotionOf(matches[i]);
    ray.direction_W = (grazed_W - ray.eye_W).normalized();
    ray.outward_W =
        (ray.outward_W - ray.outward_W.dot(ray.direction_W) * ray.direction_W).normalized();
  }
}

const std::vector<SegmentMatch>& RayMotion::Match() {
  matcher_.SetSegments(segments_);
  return matcher_.Match(seen_.capsules(), kGrazes_mm);
}

Vector3 RayMotion::MotionOf(const SegmentMatch& match) const {
  if (match.capsule < 0) return Vector3::Zero();
  return CorePlace(at_set_.capsules()[match.capsule], match.distance.share) -
         CorePlace(seen_.capsules()[match.capsule], match.distance.share);
}

}  // namespace mocap
