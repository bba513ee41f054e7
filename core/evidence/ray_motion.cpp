#include "core/evidence/ray_motion.h"

#include <algorithm>
#include <cmath>

#include "core/reconstruction/silhouette/line_range.h"

namespace mocap {
namespace {

// A trigger is more exact. In this time a hand at 3 m/s moves by 3 mm, much less than rays err.
constexpr double kAtOnce_s = 0.001;

bool IsAtOnce(const Outline& outline) {
  return outline.empty() || std::abs(outline.front().after_s) < kAtOnce_s;
}

}  // namespace

void BringToSet(const PersonMotion& motion, KeypointRays& view) {
  if (std::abs(view.after_s) < kAtOnce_s) return;
  const Posture at_set = motion.body.PostureAt(motion.pose_after(0));
  const Posture seen = motion.body.PostureAt(motion.pose_after(view.after_s));
  const LandmarkPlaces places = PlaceLandmarks(motion.body);
  for (KeypointRay& ray : view.rays) {
    const LandmarkPlace& place = places[static_cast<int>(ray.landmark)];
    ray.eye_W += PlaceIn(at_set, place) - PlaceIn(seen, place);
  }
}

void RayMotion::BringToSet(const PersonMotion& motion, const Eigen::AlignedBox3d& box_W,
                           std::vector<BoundingEdge>& edges, std::vector<Outline>& borders) {
  if (std::ranges::all_of(borders, IsAtOnce)) return;
  at_set_.Set(motion.body, motion.pose_after(0));
  for (std::size_t camera = 0; camera < borders.size(); ++camera) {
    Outline& outline = borders[camera];
    if (IsAtOnce(outline)) continue;
    seen_.Set(motion.body, motion.pose_after(outline.front().after_s));
    MoveEdges(static_cast<int>(camera), edges);
    MoveRays(box_W, outline);
  }
}

void RayMotion::MoveEdges(int camera, std::vector<BoundingEdge>& edges) {
  segments_.clear();
  places_.clear();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (edges[i].camera != camera) continue;
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
void RayMotion::MoveRays(const Eigen::AlignedBox3d& box_W, Outline& outline) {
  segments_.clear();
  places_.clear();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const GrazingRay& ray = outline[i];
    const auto range = RangeWithin(box_W, ray.eye_W, ray.direction_W);
    if (ray.empty() || !range) continue;
    segments_.push_back({ray.eye_W + range->from_mm * ray.direction_W,
                         ray.eye_W + range->to_mm * ray.direction_W, ray.outward_W});
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
  return matcher_.Match(seen_.capsules(), kReach_mm);
}

Vector3 RayMotion::MotionOf(const SegmentMatch& match) const {
  if (match.capsule < 0) return Vector3::Zero();
  return CorePlace(at_set_.capsules()[match.capsule], match.distance.share) -
         CorePlace(seen_.capsules()[match.capsule], match.distance.share);
}

}  // namespace mocap
