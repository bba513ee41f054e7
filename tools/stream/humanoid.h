// The body as bones of an avatar: the humanoid bones of Unity and VRM.
#pragma once

#include <array>
#include <string_view>

#include "core/body/body_model.h"

namespace mocap {

struct HumanoidBone {
  std::string_view name;  ///< Name in Unity's HumanBodyBones.
  int parent;             ///< -1: the root of the studio. Parents come before children.
  Segment segment;        ///< Rotates with the bone.
};

/// The humanoid bones of a measured body: all that VRM requires, clavicles and toes.
inline constexpr std::array<HumanoidBone, 21> kHumanoid = {{
    {"Hips", -1, Segment::kPelvis},
    {"Spine", 0, Segment::kTorso},
    {"Chest", 1, Segment::kTorso},
    {"Neck", 2, Segment::kHead},
    {"Head", 3, Segment::kHead},
    {"LeftShoulder", 2, Segment::kShoulderL},
    {"LeftUpperArm", 5, Segment::kUpperArmL},
    {"LeftLowerArm", 6, Segment::kLowerArmL},
    {"LeftHand", 7, Segment::kHandL},
    {"RightShoulder", 2, Segment::kShoulderR},
    {"RightUpperArm", 9, Segment::kUpperArmR},
    {"RightLowerArm", 10, Segment::kLowerArmR},
    {"RightHand", 11, Segment::kHandR},
    {"LeftUpperLeg", 0, Segment::kThighL},
    {"LeftLowerLeg", 13, Segment::kCalfL},
    {"LeftFoot", 14, Segment::kFootL},
    {"LeftToes", 15, Segment::kToesL},
    {"RightUpperLeg", 0, Segment::kThighR},
    {"RightLowerLeg", 17, Segment::kCalfR},
    {"RightFoot", 18, Segment::kFootR},
    {"RightToes", 19, Segment::kToesR},
}};

/// Transforms from each bone to its parent, in the studio's axes: x forward, y left, z up [mm]. In
/// the reference configuration, a T-pose, no bone is rotated.
using HumanoidPose = std::array<RigidTransform, kHumanoid.size()>;

/// Computes the bones of a pose. Hips is the middle of the hip joints. Spine is the torso's
/// centroid, about which a waist turns. Chest is halfway from there to the next joint, Head halfway
/// from the neck to its end. All other bones are at their joints.
HumanoidPose HumanoidPoseOf(const BodyModel& body, const PoseState& pose);

}  // namespace mocap
