// §5, §6: names of the body parts and of the 23 measured points. Enumerators keep the paper's
// numbers.
#pragma once

#include <array>
#include <string_view>

namespace mocap {

/// The ten parts of the body; 0 to 9 as in the paper's Fig. 17 and Table 2.
enum class BodyPart {
  kTorso = 0,
  kHead,
  kUpperArmL,
  kUpperArmR,
  kThighL,
  kThighR,
  kLowerArmL,
  kLowerArmR,
  kCalfL,
  kCalfR
};
inline constexpr int kBodyPartCount = 10;

/// The 23 points of Table 2, followed by joints and points that the paper's body lacks. The first
/// ten points are the centroids of the parts.
enum class Point {
  kTorso = 0,
  kHead,
  kUpperArmL,
  kUpperArmR,
  kThighL,
  kThighR,
  kLowerArmL,
  kLowerArmR,
  kCalfL,
  kCalfR,
  kNeck,
  kShoulderL,
  kShoulderR,
  kHipL,
  kHipR,
  kElbowL,
  kElbowR,
  kFingertipsL,
  kFingertipsR,
  kKneeL,
  kKneeR,
  kFootL,
  kFootR,
  kClavicleL,  ///< Sternoclavicular joint.
  kClavicleR,
  kWristL,
  kWristR,
  kAnkleL,
  kAnkleR,
  kHeelL,  ///< Back of the heel, as high as the toe.
  kHeelR,
  kBallL,  ///< Joint of the toes (metatarsophalangeal).
  kBallR,
  kToeL,  ///< Tip of the foot.
  kToeR,
  kKnucklesL,  ///< Joint of the middle finger (metacarpophalangeal).
  kKnucklesR
};
inline constexpr int kPointCount = 23;  ///< Number of points in Table 2.
inline constexpr int kPlaceCount = 37;
inline constexpr int kFurtherPointCount = kPlaceCount - kPointCount;

inline constexpr std::array<std::string_view, kPointCount> kPointNames = {
    "torso",        "head",        "upper_arm_l", "upper_arm_r", "thigh_l", "thigh_r",
    "lower_arm_l",  "lower_arm_r", "calf_l",      "calf_r",      "neck",    "shoulder_l",
    "shoulder_r",   "hip_l",       "hip_r",       "elbow_l",     "elbow_r", "fingertips_l",
    "fingertips_r", "knee_l",      "knee_r",      "foot_l",      "foot_r"};
/// Names of the points that follow the 23.
inline constexpr std::array<std::string_view, kFurtherPointCount> kFurtherPointNames = {
    "clavicle_l", "clavicle_r", "wrist_l", "wrist_r", "ankle_l", "ankle_r",    "heel_l",
    "heel_r",     "ball_l",     "ball_r",  "toe_l",   "toe_r",   "knuckles_l", "knuckles_r"};

/// Points of the feet that touch the floor: heels and toes.
inline constexpr std::array<Point, 4> kContactPoints = {Point::kHeelL, Point::kHeelR, Point::kToeL,
                                                        Point::kToeR};
inline constexpr int kContactCount = 4;
inline constexpr std::array<std::string_view, kContactCount> kContactNames = {"heel_l", "heel_r",
                                                                              "toe_l", "toe_r"};

/// Number of rotation axes of the paper's body (Table 1).
inline constexpr int kPaperAngleCount = 16;

}  // namespace mocap
