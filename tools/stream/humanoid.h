// The body as the bones of avatars: those that Unity and VRM want of a humanoid.
#pragma once

#include <array>
#include <string_view>

#include "core/body/body_model.h"

namespace mocap {

struct HumanoidBone {
  std::string_view name;  ///< Of Unity's HumanBodyBones.
  int parent;             ///< -1: the root of the studio. A parent stands before its children.
  Segment segment;        ///< Turns with the bone.
};

/// What a measured body has of them: all that VRM requires, and the collar bones.
inline constexpr std::array<HumanoidBone, 19> kHumanoid = {{
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
    {"RightUpperLeg", 0, Segment::kThighR},
    {"RightLowerLeg", 16, Segment::kCalfR},
    {"RightFoot", 17, Segment::kFootR},
}};

/// From each bone to its parent, in the axes of the studio: x forward, y left, z up [mm]. At the
/// reference configuration, a T-pose, no bone is turned.
using HumanoidPose = std::array<RigidTransform, kHumanoid.size()>;

/// Reads the bones off a pose. Hips is the middle of the hip joints, Spine the torso's centroid,
/// about which a waist turns; Chest and Head lie halfway from there, and from the neck, to what
/// follows; all others lie in their joints.
HumanoidPose HumanoidPoseOf(const BodyModel& body, const PoseState& pose);

}  // namespace mocap
