// The simulated person's skeleton: anatomical joint angles, the resulting bone poses, and the
// points of truth.csv.
//
// Every bone's frame has x forward, y to the person's left and z up along the bone when the person
// stands upright with hanging arms. All angles are 0 then.
#pragma once

#include <array>
#include <string_view>

#include "core/geometry.h"
#include "drivers/virtual_studio/people/anthropometry.h"

namespace mocap::simulation {

inline constexpr int kLeft = 0, kRight = 1;

/// +1 for the left side (+y), -1 for the right.
constexpr double SideSign(int side) { return side == kLeft ? 1 : -1; }

/// Angles of a ball joint of the trunk [rad].
struct TrunkAngles {
  double flexion = 0;  ///< Forward.
  double bend = 0;     ///< To the left.
  double twist = 0;    ///< To the left.
};

/// [rad]
struct ArmAngles {
  double clavicle_up = 0, clavicle_forward = 0;
  double flexion = 0;    ///< Upper arm forward and up.
  double abduction = 0;  ///< Upper arm out and up, before it is flexed.
  double rotation = 0;   ///< About the upper arm: the bent forearm inward.
  double elbow = 0;      ///< Flexion.
  double pronation = 0;  ///< Back of the hand forward.
  double wrist = 0;      ///< Flexion towards the palm.
};

/// [rad]
struct LegAngles {
  double flexion = 0;    ///< Thigh forward and up.
  double abduction = 0;  ///< Thigh out, before it is flexed.
  double rotation = 0;   ///< About the thigh: toes inward.
  double knee = 0;       ///< Flexion: the heel back and up.
  double ankle = 0;      ///< Dorsiflexion: toes up.
  double inversion = 0;  ///< Sole inward.
  double foot_turn = 0;  ///< About the shank: toes inward.
  double toes = 0;       ///< Extension: toes up.
};

/// A posture: position of the pelvis and every joint angle.
struct BodyPose {
  Vector3 p_WPelvis = Vector3::Zero();  ///< Midpoint of the hip joints.
  Matrix3 R_WPelvis = Matrix3::Identity();
  TrunkAngles lumbar, thorax, neck, head;
  std::array<ArmAngles, 2> arms;
  std::array<LegAngles, 2> legs;
};

enum Bone {
  kPelvis,
  kLumbar,
  kThorax,
  kNeck,
  kHead,
  kClavicleL,
  kClavicleR,
  kUpperArmL,
  kUpperArmR,
  kForearmL,
  kForearmR,
  kHandL,
  kHandR,
  kThighL,
  kThighR,
  kShankL,
  kShankR,
  kFootL,
  kFootR,
  kToesL,
  kToesR
};
inline constexpr int kBoneCount = 21;

/// X_WB of every bone; its origin is the joint about which it turns.
using BonePoses = std::array<RigidTransform, kBoneCount>;

/// Computes the pose of every bone.
BonePoses PlaceBones(const Anthropometry& body, const BodyPose& pose);

/// The points of truth.csv, in its order.
enum class TruthPoint {
  kPelvis,
  kNeck,
  kHead,
  kShoulderL,
  kShoulderR,
  kElbowL,
  kElbowR,
  kWristL,
  kWristR,
  kFingertipsL,
  kFingertipsR,
  kHipL,
  kHipR,
  kKneeL,
  kKneeR,
  kAnkleL,
  kAnkleR,
  kToeL,
  kToeR,
  kHeelL,
  kHeelR,
  kBallL,
  kBallR,
  kKnucklesL,
  kKnucklesR
};
inline constexpr int kTruthPointCount = 25;

inline constexpr std::array<std::string_view, kTruthPointCount> kTruthPointNames = {
    "pelvis",  "neck",    "head",         "shoulder_l",   "shoulder_r", "elbow_l", "elbow_r",
    "wrist_l", "wrist_r", "fingertips_l", "fingertips_r", "hip_l",      "hip_r",   "knee_l",
    "knee_r",  "ankle_l", "ankle_r",      "toe_l",        "toe_r",      "heel_l",  "heel_r",
    "ball_l",  "ball_r",  "knuckles_l",   "knuckles_r"};

/// p_WQ of every truth point [mm].
using TruePoints = std::array<Vector3, kTruthPointCount>;

/// Computes the truth points from bone poses.
TruePoints PointsOf(const Anthropometry& body, const BonePoses& bones);

/// Height of the toes' joint and tip above the sole, as a share of the stature.
inline constexpr double kToeHeight = 0.012;

/// Middle of the skull in the head's frame.
Vector3 HeadCenterInHead(const Anthropometry& body);

/// Target of a foot: the ankle, and the directions of foot and toes.
struct FootTarget {
  Vector3 p_WAnkle = Vector3::Zero();
  Matrix3 R_WFoot = Matrix3::Identity();
  double toes_rad = 0;  ///< Extension of the toes against the foot.
};

/// Angles of a limb of two links that reaches over a distance, by the law of cosines [rad].
struct LimbFold {
  double bend = 0;     ///< Between the links; 0 when they are in line.
  double at_root = 0;  ///< From the line to the target to the first link.
};
LimbFold FoldTo(double distance_mm, double first_mm, double second_mm);

/// Bends a leg to bring its foot to the target, with the knee in the foot's direction. A target out
/// of reach is approached with a straight leg.
void PlaceLeg(const Anthropometry& body, int side, const FootTarget& target, BodyPose& pose);

/// Bends an arm to bring the middle of its straight hand to a point, elbow down and slightly out. A
/// point out of reach is approached with a straight arm. The clavicle does not move.
void ReachWith(const Anthropometry& body, int side, const Vector3& p_WHand, BodyPose& pose);

}  // namespace mocap::simulation
