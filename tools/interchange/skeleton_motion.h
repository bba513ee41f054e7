// A result as a skeleton of joints, for animation programs.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/geometry.h"
#include "tools/results/result.h"

namespace mocap {

/// Joints, with names common in animation programs, and ends of limbs. Joints come before their
/// children.
///
/// Hips is the middle of the hip joints. Spine is the torso's centroid. A waist turns about it, so
/// its distance from the hips is constant, unlike that from hips to neck. LeftShoulder is the joint
/// of clavicle and sternum, LeftHand the wrist.
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
  bool is_end = false;  ///< End of a limb: does not rotate.
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

/// Per joint, in the order of kSkeletonJoints.
using JointOffsets = std::array<Vector3, kSkeletonJointCount>;

struct SkeletonPose {
  std::int64_t time_ns = 0;  ///< Capture time.
  /// From the parent joint, in its axes; the root's from the world origin [mm].
  JointOffsets offset;
  std::array<Matrix3, kSkeletonJointCount> R;  ///< From joint to parent; the root's to the world.
};

/// Positions of a pose's joints, with its own bones or those of another pose; p_W [mm].
/// @param offset  of each joint except the root.
JointOffsets PlacesAt(const SkeletonPose& pose, const JointOffsets& offset);

struct SkeletonMotion {
  /// Bones of the last tracked frame, when sizes have settled. With all joints at rest, arms are
  /// out to the sides and legs down, in the torso's axes; the root's is zero.
  JointOffsets bones;
  std::vector<SkeletonPose> frames;  ///< Evenly spaced except for jitter of capture times.
  double period_s = 0;
  int skipped_frames = 0;  ///< Before the first tracked frame.
  int held_frames = 0;     ///< Missing or not tracked: repeats of the last pose.
  /// Largest distance of a joint from its position with those bones; not 0 if bones change.
  double worst_mm = 0;
};

/// Positions of a body's joints at rest, in the torso frame [mm].
JointOffsets RestPlaces(const BodyRecord& body);

/// Makes the skeleton's motion from the tracked frames. Joints are at the points. Rotations of a
/// limb about itself are omitted, as points do not show them.
/// @throws SetupError  when no frame is tracked, and as RequireShortGap.
SkeletonMotion MakeSkeletonMotion(const Result& result);

}  // namespace mocap
