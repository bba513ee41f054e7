// A result as a skeleton of joints with constant bones, as BVH wants it.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/body/body_part.h"
#include "core/geometry.h"
#include "tools/results/result.h"

namespace mocap {

/// The joints, with the names that animation programs know. A joint stands before its children.
///
/// Hips is the middle of the hip joints. Spine is the torso's centroid: a waist turns about it, so
/// its distance from the hips stays the same, as that of hips and neck would not.
enum class BvhJoint {
  kHips = 0,
  kSpine,
  kNeck,
  kHead,
  kLeftArm,
  kLeftForeArm,
  kRightArm,
  kRightForeArm,
  kLeftUpLeg,
  kLeftLeg,
  kRightUpLeg,
  kRightLeg
};
inline constexpr int kBvhJointCount = 12;

struct BvhJointInfo {
  std::string_view name;
  int parent;   ///< -1: the root.
  Point start;  ///< Where the joint is; unused for the hips.
};
inline constexpr std::array<BvhJointInfo, kBvhJointCount> kBvhJoints = {{
    {"Hips", -1, Point::kTorso},
    {"Spine", 0, Point::kTorso},
    {"Neck", 1, Point::kNeck},
    {"Head", 2, Point::kHead},
    {"LeftArm", 1, Point::kShoulderL},
    {"LeftForeArm", 4, Point::kElbowL},
    {"RightArm", 1, Point::kShoulderR},
    {"RightForeArm", 6, Point::kElbowR},
    {"LeftUpLeg", 0, Point::kHipL},
    {"LeftLeg", 8, Point::kKneeL},
    {"RightUpLeg", 0, Point::kHipR},
    {"RightLeg", 10, Point::kKneeR},
}};

/// Where each joint and the ends of the limbs lie in the rest pose (arms out to the sides, legs
/// down), from its parent joint, in the torso's axes [mm].
struct BvhSkeleton {
  std::array<Vector3, kBvhJointCount> offset;
  std::array<Vector3, kBvhJointCount> end;  ///< Of joints without children; zero for others.
};

struct BvhPose {
  Vector3 p_WHips;
  std::array<Matrix3, kBvhJointCount>
      R;  ///< From the joint to its parent; the root's to the world.
};

struct BvhMotion {
  BvhSkeleton skeleton;
  std::vector<BvhPose> frames;
  double period_s = 0;
  int skipped_frames = 0;  ///< Before the first tracked one.
  int held_frames = 0;     ///< Missing or not tracked: the last pose again.
  /// Largest distance of a joint from its point; not 0 where the result's bones change.
  double worst_mm = 0;
};

/// Fits the skeleton to all tracked frames. Bones have the median of their lengths; turns of a limb
/// about itself, which points do not show, are left out.
/// @throws SetupError  when no frame is tracked, or an hour or more of frames is missing in one
/// place.
BvhMotion MakeBvhMotion(const Result& result);

}  // namespace mocap
