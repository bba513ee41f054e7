// Beyond the paper: cameras without a common trigger see a person at different moments.
#pragma once

#include <functional>
#include <vector>

#include "core/body/posed_body.h"
#include "core/body/segment_matcher.h"
#include "core/evidence/bounding_edges.h"
#include "core/evidence/keypoint_rays.h"
#include "core/reconstruction/silhouette/outline.h"

namespace mocap {

/// How a person moves about the time of a set.
struct PersonMotion {
  const BodyModel& body;
  /// The pose a time after that of the set [s], or before it.
  std::function<PoseState(double after_s)> pose_after;
};

/// Moves the lines of sight of a view that was taken before or after its set, each with its own
/// point of the body.
void BringToSet(const PersonMotion& motion, KeypointRays& view);

/// Moves rays and edges to the moment of their set. Each keeps grazing the place of the body that
/// it grazed when its picture was taken, as if all pictures had been taken at once. What grazes no
/// part of the body stays. Reuses its memory.
class RayMotion {
 public:
  /// @param box_W    contains the person [mm].
  /// @param borders  one outline per camera.
  void BringToSet(const PersonMotion& motion, const Eigen::AlignedBox3d& box_W,
                  std::vector<BoundingEdge>& edges, std::vector<Outline>& borders);

 private:
  void MoveEdges(int camera, std::vector<BoundingEdge>& edges);
  void MoveRays(const Eigen::AlignedBox3d& box_W, Outline& outline);
  const std::vector<SegmentMatch>& Match();
  Vector3 MotionOf(const SegmentMatch& match) const;

  PosedBody seen_, at_set_;  ///< When a camera took its picture, and at the moment of the set.
  SegmentMatcher matcher_;
  std::vector<OrientedSegment> segments_;
  std::vector<std::size_t> places_;  ///< Of the segments, among edges or rays.
};

}  // namespace mocap
