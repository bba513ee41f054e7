// Skeletons for animation programs: names, parents and axes of the joints.
#pragma once

#include <span>
#include <string_view>

#include "core/body/body_part.h"
#include "core/body/body_table.h"

namespace mocap {

/// Joints of mocapd's own skeleton, with names common in animation programs, and ends of limbs.
/// Joints come before their children.
///
/// Hips is the middle of the hip joints. Spine is the torso's centroid. A waist turns about it, so
/// its distance from the hips is constant, unlike that from hips to neck. LeftShoulder is the joint
/// of clavicle and sternum, LeftHand the wrist, LeftFoot the ankle, LeftToe the joint of the toes.
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
  kLeftFoot,
  kLeftToe,
  kLeftToeEnd,
  kRightUpLeg,
  kRightLeg,
  kRightFoot,
  kRightToe,
  kRightToeEnd
};
inline constexpr int kSkeletonJointCount = 25;

/// Places of joints that are no points of the body: the middle of the hip joints, two between there
/// and the torso's centroid, and the top of the head.
inline constexpr auto kHipsMiddle = static_cast<Point>(kPlaceCount);
inline constexpr auto kLowSpine = static_cast<Point>(kPlaceCount + 1);
inline constexpr auto kMiddleSpine = static_cast<Point>(kPlaceCount + 2);
inline constexpr auto kHeadTop = static_cast<Point>(kPlaceCount + 3);
inline constexpr int kSkeletonPlaceCount = kPlaceCount + 4;

/// Axes of a joint in the reference configuration: arms out to the sides, legs down.
enum class BoneAxes {
  kStudio,   ///< Of all joints alike: x to the person's left, y up, z forward.
  kForward,  ///< x along the bone, or up at the root; y forward.
  kBackward,
  kUpward
};

struct SkeletonJointInfo {
  std::string_view name;
  int parent;       ///< -1: the root.
  Segment segment;  ///< Turns with the joint.
  Point place;
  BoneAxes axes = BoneAxes::kStudio;
  bool is_end = false;  ///< End of a limb: does not rotate.
};

/// A joint's bone leads to the next one in the list, except for the root's.
struct Skeleton {
  std::string_view name;     ///< For --skeleton.
  std::string_view purpose;  ///< For the help.
  std::span<const SkeletonJointInfo> joints;
  std::string_view rotations;  ///< Order of BVH's rotation channels: "ZXY" or "ZYX".
};

/// mocapd's own, whose joints are those of SkeletonJoint. In the reference configuration, no joint
/// is rotated.
const Skeleton& MocapdSkeleton();
/// That of the data set LAFAN1 (Harvey et al. 2020), for which retargeters to robots are made.
/// Bones lie along x of their joints. The waist turns at Spine2, which is the torso's centroid.
const Skeleton& Lafan1Skeleton();

/// All skeletons, in the order of the help.
std::span<const Skeleton* const> Skeletons();
/// @throws SetupError  for an unknown name.
const Skeleton& FindSkeleton(std::string_view name);

}  // namespace mocap
