// A result as a skeleton of joints, as animation programs want it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/geometry.h"
#include "tools/results/result.h"

namespace mocap {

/// The joints, with the names that animation programs know, and the ends of the limbs. A joint
/// stands before its children.
///
/// Hips is the middle of the hip joints. Spine is the torso's centroid: a waist turns about it, so
/// its distance from the hips stays the same, as that of hips and neck would not. LeftShoulder is
/// where the collar bone meets the breast bone, LeftHand the wrist.
enum class SkeletonJoint {
  kHips = 0,
  kSpine,
  kNeck,
  kHead,
  kHeadEnd,
  kLeftShoulder,
  kLeftArm,
  kLeftForeArm,
  kLeftHand,
  kLeftHandEnd,
  kRightShoulder,
  kRightArm,
  kRightForeArm,
  kRightHand,
  kRightHandEnd,
  kLeftUpLeg,
  kLeftLeg,
  kLeftLegEnd,
  kRightUpLeg,
  kRightLeg,
  kRightLegEnd
};
inline constexpr int kSkeletonJointCount = 21;

struct SkeletonJointInfo {
  std::string_view name;
  int parent;           ///< -1: the root.
  bool is_end = false;  ///< Where a limb ends: does not turn.
};
inline constexpr std::array<SkeletonJointInfo, kSkeletonJointCount> kSkeletonJoints = {{
    {"Hips", -1},
    {"Spine", 0},
    {"Neck", 1},
    {"Head", 2},
    {"HeadEnd", 3, true},
    {"LeftShoulder", 1},
    {"LeftArm", 5},
    {"LeftForeArm", 6},
    {"LeftHand", 7},
    {"LeftHandEnd", 8, true},
    {"RightShoulder", 1},
    {"RightArm", 10},
    {"RightForeArm", 11},
    {"RightHand", 12},
    {"RightHandEnd", 13, true},
    {"LeftUpLeg", 0},
    {"LeftLeg", 15},
    {"LeftLegEnd", 16, true},
    {"RightUpLeg", 0},
    {"RightLeg", 18},
    {"RightLegEnd", 19, true},
}};

/// Of each joint, in the order of kSkeletonJoints.
using JointOffsets = std::array<Vector3, kSkeletonJointCount>;

struct SkeletonPose {
  std::int64_t time_ns = 0;  ///< Of capture.
  /// From the parent joint, in its axes; the root's from the world's origin [mm].
  JointOffsets offset;
  std::array<Matrix3, kSkeletonJointCount> R;  ///< From joint to parent; the root's to the world.
};

/// Where a pose puts the joints, with bones of its own or of another pose; p_W [mm].
/// @param offset  of each joint but the root.
JointOffsets PlacesAt(const SkeletonPose& pose, const JointOffsets& offset);

struct SkeletonMotion {
  /// Bones as they are in the last tracked frame, when sizes have settled. With all joints at rest
  /// arms are out to the sides and legs down, in the torso's axes; the root's is zero.
  JointOffsets bones;
  std::vector<SkeletonPose> frames;  ///< Evenly spaced but for what capture times jitter.
  double period_s = 0;
  int skipped_frames = 0;  ///< Before the first tracked one.
  int held_frames = 0;     ///< Missing or not tracked: the last pose again.
  /// Largest distance of a joint from its place with those bones; not 0 where bones change.
  double worst_mm = 0;
};

/// Places of the joints of a body with all joints at rest, in the torso's frame [mm].
JointOffsets RestPlaces(const BodyRecord& body);

/// Makes the skeleton's motion from the tracked frames. Joints lie where the points are; turns of a
/// limb about itself, which points do not show, are left out.
/// @throws SetupError  when no frame is tracked, and as RequireShortGap.
SkeletonMotion MakeSkeletonMotion(const Result& result);

}  // namespace mocap
