#include "tools/interchange/skeletons.h"

#include <algorithm>
#include <array>
#include <string>

#include "core/errors.h"

namespace mocap {
namespace {

constexpr SkeletonJointInfo End(std::string_view name, int parent, Segment segment, Point place) {
  return {name, parent, segment, place, BoneAxes::kStudio, true};
}

constexpr std::array<SkeletonJointInfo, kSkeletonJointCount> kMocapdJoints = {{
    {"Hips", -1, Segment::kPelvis, kHipsMiddle},
    {"Spine", 0, Segment::kTorso, Point::kTorso},
    {"Neck", 1, Segment::kHead, Point::kNeck},
    {"Head", 2, Segment::kHead, Point::kHead},
    End("HeadEnd", 3, Segment::kHead, kHeadTop),
    {"LeftShoulder", 1, Segment::kShoulderL, Point::kClavicleL},
    {"LeftArm", 5, Segment::kUpperArmL, Point::kShoulderL},
    {"LeftForeArm", 6, Segment::kLowerArmL, Point::kElbowL},
    {"LeftHand", 7, Segment::kHandL, Point::kWristL},
    End("LeftHandEnd", 8, Segment::kHandL, Point::kFingertipsL),
    {"RightShoulder", 1, Segment::kShoulderR, Point::kClavicleR},
    {"RightArm", 10, Segment::kUpperArmR, Point::kShoulderR},
    {"RightForeArm", 11, Segment::kLowerArmR, Point::kElbowR},
    {"RightHand", 12, Segment::kHandR, Point::kWristR},
    End("RightHandEnd", 13, Segment::kHandR, Point::kFingertipsR),
    {"LeftUpLeg", 0, Segment::kThighL, Point::kHipL},
    {"LeftLeg", 15, Segment::kCalfL, Point::kKneeL},
    {"LeftFoot", 16, Segment::kFootL, Point::kAnkleL},
    {"LeftToe", 17, Segment::kToesL, Point::kBallL},
    End("LeftToeEnd", 18, Segment::kToesL, Point::kToeL),
    {"RightUpLeg", 0, Segment::kThighR, Point::kHipR},
    {"RightLeg", 20, Segment::kCalfR, Point::kKneeR},
    {"RightFoot", 21, Segment::kFootR, Point::kAnkleR},
    {"RightToe", 22, Segment::kToesR, Point::kBallR},
    End("RightToeEnd", 23, Segment::kToesR, Point::kToeR),
}};

constexpr std::array<SkeletonJointInfo, 27> kLafan1Joints = {{
    {"Hips", -1, Segment::kPelvis, kHipsMiddle, BoneAxes::kForward},
    {"LeftUpLeg", 0, Segment::kThighL, Point::kHipL, BoneAxes::kForward},
    {"LeftLeg", 1, Segment::kCalfL, Point::kKneeL, BoneAxes::kForward},
    {"LeftFoot", 2, Segment::kFootL, Point::kAnkleL, BoneAxes::kUpward},
    {"LeftToe", 3, Segment::kToesL, Point::kBallL, BoneAxes::kUpward},
    End("LeftToeEnd", 4, Segment::kToesL, Point::kToeL),
    {"RightUpLeg", 0, Segment::kThighR, Point::kHipR, BoneAxes::kForward},
    {"RightLeg", 6, Segment::kCalfR, Point::kKneeR, BoneAxes::kForward},
    {"RightFoot", 7, Segment::kFootR, Point::kAnkleR, BoneAxes::kUpward},
    {"RightToe", 8, Segment::kToesR, Point::kBallR, BoneAxes::kUpward},
    End("RightToeEnd", 9, Segment::kToesR, Point::kToeR),
    {"Spine", 0, Segment::kPelvis, kLowSpine, BoneAxes::kForward},
    {"Spine1", 11, Segment::kPelvis, kMiddleSpine, BoneAxes::kForward},
    {"Spine2", 12, Segment::kTorso, Point::kTorso, BoneAxes::kForward},
    {"Neck", 13, Segment::kHead, Point::kNeck, BoneAxes::kForward},
    {"Head", 14, Segment::kHead, Point::kHead, BoneAxes::kForward},
    End("HeadEnd", 15, Segment::kHead, kHeadTop),
    {"LeftShoulder", 13, Segment::kShoulderL, Point::kClavicleL, BoneAxes::kBackward},
    {"LeftArm", 17, Segment::kUpperArmL, Point::kShoulderL, BoneAxes::kBackward},
    {"LeftForeArm", 18, Segment::kLowerArmL, Point::kElbowL, BoneAxes::kBackward},
    {"LeftHand", 19, Segment::kHandL, Point::kWristL, BoneAxes::kBackward},
    End("LeftHandEnd", 20, Segment::kHandL, Point::kFingertipsL),
    {"RightShoulder", 13, Segment::kShoulderR, Point::kClavicleR, BoneAxes::kBackward},
    {"RightArm", 22, Segment::kUpperArmR, Point::kShoulderR, BoneAxes::kBackward},
    {"RightForeArm", 23, Segment::kLowerArmR, Point::kElbowR, BoneAxes::kBackward},
    {"RightHand", 24, Segment::kHandR, Point::kWristR, BoneAxes::kBackward},
    End("RightHandEnd", 25, Segment::kHandR, Point::kFingertipsR),
}};

constexpr Skeleton kMocapd = {"mocapd", "in a T-pose, no joint is rotated", kMocapdJoints, "ZXY"};
constexpr Skeleton kLafan1 = {"lafan1", "names and axes of LAFAN1, for robots' retargeters",
                              kLafan1Joints, "ZYX"};
constexpr std::array<const Skeleton*, 2> kSkeletons = {&kMocapd, &kLafan1};

}  // namespace

const Skeleton& MocapdSkeleton() { return kMocapd; }
const Skeleton& Lafan1Skeleton() { return kLafan1; }

std::span<const Skeleton* const> Skeletons() { return kSkeletons; }

const Skeleton& FindSkeleton(std::string_view name) {
  const auto skeleton = std::ranges::find(kSkeletons, name, &Skeleton::name);
  if (skeleton == kSkeletons.end()) throw SetupError(std::string(name) + ": is not a skeleton");
  return **skeleton;
}

}  // namespace mocap
