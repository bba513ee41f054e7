// A result as a skeleton of joints, for animation programs.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "tools/interchange/skeletons.h"
#include "tools/results/result.h"

namespace mocap {

/// Per joint, in the order of the skeleton's.
using JointOffsets = std::vector<Vector3>;

struct SkeletonPose {
  std::int64_t time_ns = 0;  ///< Capture time.
  /// From the parent joint, in its axes; the root's from the world's origin, y up [mm].
  JointOffsets offset;
  std::vector<Matrix3> R;  ///< From joint to parent; the root's to the world, y up.
};

/// Positions of a pose's joints, with its own bones or those of another pose; y up [mm].
/// @param offset  of each joint except the root.
JointOffsets PlacesAt(const Skeleton& skeleton, const SkeletonPose& pose,
                      const JointOffsets& offset);

/// In the world of YUpFromWorld.
struct SkeletonMotion {
  /// Bones of the last tracked frame, when sizes have settled. The root's is zero.
  JointOffsets bones;
  std::vector<SkeletonPose> frames;  ///< Evenly spaced except for jitter of capture times.
  double period_s = 0;
  int skipped_frames = 0;  ///< Before the first tracked frame.
  int held_frames = 0;     ///< Missing or not tracked: repeats of the last pose.
  /// Largest distance of a joint from its position with those bones; not 0 if bones change.
  double worst_mm = 0;
};

/// Positions of a body's joints in the reference configuration, with the torso's centroid at the
/// origin; y up, z forward [mm].
JointOffsets RestPlaces(const BodyRecord& body);

/// Makes the skeleton's motion from the tracked frames. Joints are at the points, and turn as the
/// segments do: see SegmentPoser. The feet of earlier versions, without points of their own, are
/// fixed to the shin.
/// @throws SetupError  when no frame is tracked, and as RequireShortGap.
SkeletonMotion MakeSkeletonMotion(const Result& result,
                                  const Skeleton& skeleton = MocapdSkeleton());

}  // namespace mocap
