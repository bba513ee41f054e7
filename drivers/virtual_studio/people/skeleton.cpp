#include "drivers/virtual_studio/people/skeleton.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mocap::simulation {
namespace {

// The knuckles, of the hand (de Leva 1996: 86 of 188 mm).
constexpr double kKnucklesShare = 0.46;

Matrix3 TurnX(double a) { return Eigen::AngleAxisd(a, Vector3::UnitX()).toRotationMatrix(); }
Matrix3 TurnY(double a) { return Eigen::AngleAxisd(a, Vector3::UnitY()).toRotationMatrix(); }
Matrix3 TurnZ(double a) { return Eigen::AngleAxisd(a, Vector3::UnitZ()).toRotationMatrix(); }

Matrix3 RotationOf(const TrunkAngles& a) {
  return TurnZ(a.twist) * TurnY(a.flexion) * TurnX(-a.bend);
}

// A limb hangs along -z. Turning about +y moves it back, about +x to the left.
Matrix3 LimbRotation(double flexion, double abduction, double rotation, double sign) {
  return TurnY(-flexion) * TurnX(sign * abduction) * TurnZ(-sign * rotation);
}

struct LimbAngles {
  double flexion, abduction, rotation;
};

LimbAngles AnglesOfLimb(const Matrix3& R, double sign) {
  // R = Ry(a) Rx(b) Rz(c): R(1,2) = -sin b, R(0,2)/R(2,2) = tan a, R(1,0)/R(1,1) = tan c.
  const double a = std::atan2(R(0, 2), R(2, 2));
  const double b = std::asin(std::clamp(-R(1, 2), -1.0, 1.0));
  const double c = std::atan2(R(1, 0), R(1, 1));
  return {-a, sign * b, -sign * c};
}

void PlaceArm(const Anthropometry& body, const ArmAngles& arm, int side, BonePoses& bones) {
  const double sign = SideSign(side);
  // The clavicle turns about its inner end, beside the top of the breastbone.
  const Vector3 inner(0.012 * body.stature_mm, sign * 0.014 * body.stature_mm,
                      body.shoulder_mm - body.thorax_mm + 0.004 * body.stature_mm);
  const Vector3 shoulder(-0.006 * body.stature_mm, sign * body.shoulder_half_mm,
                         body.shoulder_mm - body.thorax_mm);
  bones[kClavicleL + side] =
      bones[kThorax] *
      RigidTransform{TurnX(sign * arm.clavicle_up) * TurnZ(-sign * arm.clavicle_forward), inner};
  bones[kUpperArmL + side] =
      bones[kClavicleL + side] * RigidTransform{Matrix3::Identity(), shoulder - inner};
  // Shoulder angles are relative to the thorax; the clavicle only moves the joint.
  bones[kUpperArmL + side].R =
      bones[kThorax].R * LimbRotation(arm.flexion, arm.abduction, arm.rotation, sign);
  bones[kForearmL + side] = bones[kUpperArmL + side] *
                            RigidTransform{TurnY(-arm.elbow), Vector3(0, 0, -body.upper_arm_mm)};
  bones[kHandL + side] = bones[kForearmL + side] *
                         RigidTransform{TurnZ(-sign * arm.pronation) * TurnX(-sign * arm.wrist),
                                        Vector3(0, 0, -body.forearm_mm)};
}

void PlaceLegBones(const Anthropometry& body, const LegAngles& leg, int side, BonePoses& bones) {
  const double sign = SideSign(side);
  bones[kThighL + side] =
      bones[kPelvis] * RigidTransform{LimbRotation(leg.flexion, leg.abduction, leg.rotation, sign),
                                      Vector3(0, sign * body.hip_half_mm, 0)};
  bones[kShankL + side] =
      bones[kThighL + side] * RigidTransform{TurnY(leg.knee), Vector3(0, 0, -body.thigh_mm)};
  bones[kFootL + side] =
      bones[kShankL + side] *
      RigidTransform{LimbRotation(leg.ankle, -leg.inversion, leg.foot_turn, sign),
                     Vector3(0, 0, -body.shank_mm)};
  bones[kToesL + side] =
      bones[kFootL + side] *
      RigidTransform{
          TurnY(-leg.toes),
          Vector3(body.ball_mm, 0, -body.ankle_to_sole_mm + kToeHeight * body.stature_mm)};
}

}  // namespace

BonePoses PlaceBones(const Anthropometry& body, const BodyPose& pose) {
  BonePoses bones;
  bones[kPelvis] = {pose.R_WPelvis, pose.p_WPelvis};
  bones[kLumbar] =
      bones[kPelvis] * RigidTransform{RotationOf(pose.lumbar), Vector3(0, 0, body.lumbar_mm)};
  bones[kThorax] = bones[kLumbar] * RigidTransform{RotationOf(pose.thorax),
                                                   Vector3(0, 0, body.thorax_mm - body.lumbar_mm)};
  bones[kNeck] = bones[kThorax] *
                 RigidTransform{RotationOf(pose.neck), Vector3(-0.008 * body.stature_mm, 0,
                                                               body.torso_mm - body.thorax_mm)};
  bones[kHead] =
      bones[kNeck] * RigidTransform{RotationOf(pose.head),
                                    Vector3(0.012 * body.stature_mm, 0, body.skull_base_mm)};
  for (const int side : {kLeft, kRight}) {
    PlaceArm(body, pose.arms[side], side, bones);
    PlaceLegBones(body, pose.legs[side], side, bones);
  }
  return bones;
}

Vector3 HeadCenterInHead(const Anthropometry& body) {
  const double vertex_above_neck = body.stature_mm - body.hip_height_mm() - body.torso_mm;
  return {0.006 * body.stature_mm, 0, vertex_above_neck - body.head_mm / 2 - body.skull_base_mm};
}

TruePoints PointsOf(const Anthropometry& body, const BonePoses& bones) {
  TruePoints points;
  const auto set = [&](TruthPoint point, int side, const Vector3& p_W) {
    points[static_cast<int>(point) + side] = p_W;
  };
  set(TruthPoint::kPelvis, 0, bones[kPelvis].p);
  set(TruthPoint::kNeck, 0, bones[kNeck].p);
  set(TruthPoint::kHead, 0, bones[kHead] * HeadCenterInHead(body));
  for (const int side : {kLeft, kRight}) {
    set(TruthPoint::kShoulderL, side, bones[kUpperArmL + side].p);
    set(TruthPoint::kElbowL, side, bones[kForearmL + side].p);
    set(TruthPoint::kWristL, side, bones[kHandL + side].p);
    set(TruthPoint::kFingertipsL, side, bones[kHandL + side] * Vector3(0, 0, -body.hand_mm));
    set(TruthPoint::kHipL, side, bones[kThighL + side].p);
    set(TruthPoint::kKneeL, side, bones[kShankL + side].p);
    set(TruthPoint::kAnkleL, side, bones[kFootL + side].p);
    const double toe_mm = body.foot_mm - body.heel_mm - body.ball_mm;
    set(TruthPoint::kToeL, side, bones[kToesL + side] * Vector3(toe_mm, 0, 0));
    set(TruthPoint::kBallL, side, bones[kToesL + side].p);
    // As high above the sole as the toes.
    const double sole_mm = body.ankle_to_sole_mm - kToeHeight * body.stature_mm;
    set(TruthPoint::kHeelL, side, bones[kFootL + side] * Vector3(-body.heel_mm, 0, -sole_mm));
    set(TruthPoint::kKnucklesL, side,
        bones[kHandL + side] * Vector3(0, 0, -kKnucklesShare * body.hand_mm));
  }
  return points;
}

LimbFold FoldTo(double distance_mm, double a_mm, double b_mm) {
  const double d = std::clamp(distance_mm, 0.3 * (a_mm + b_mm), 0.9999 * (a_mm + b_mm));
  return {std::numbers::pi - std::acos((a_mm * a_mm + b_mm * b_mm - d * d) / (2 * a_mm * b_mm)),
          std::acos((a_mm * a_mm + d * d - b_mm * b_mm) / (2 * a_mm * d))};
}

void PlaceLeg(const Anthropometry& body, int side, const FootTarget& target, BodyPose& pose) {
  const double sign = SideSign(side);
  const Vector3 p_WHip = pose.p_WPelvis + pose.R_WPelvis * Vector3(0, sign * body.hip_half_mm, 0);
  const Vector3 reach = target.p_WAnkle - p_WHip;
  const auto [knee, at_hip] = FoldTo(reach.norm(), body.thigh_mm, body.shank_mm);

  // The leg's plane contains the line to the ankle and the direction of the foot. With the heel up,
  // the foot may point nearly along that line: then the pelvis defines forward.
  const Vector3 down = reach.normalized();
  const Vector3 foot_forward = target.R_WFoot.col(1).cross(Vector3::UnitZ());
  const Vector3 forward = 0.85 * foot_forward.normalized() + 0.15 * pose.R_WPelvis.col(0);
  const Vector3 left = forward.cross(down).normalized();
  const Vector3 ahead = down.cross(left);
  const Vector3 thigh_down = std::cos(at_hip) * down + std::sin(at_hip) * ahead;
  Matrix3 R_WThigh;
  R_WThigh << -thigh_down.cross(left), left, -thigh_down;
  R_WThigh.col(0) = left.cross(R_WThigh.col(2));

  LegAngles& leg = pose.legs[side];
  const LimbAngles hip = AnglesOfLimb(pose.R_WPelvis.transpose() * R_WThigh, sign);
  leg.flexion = hip.flexion;
  leg.abduction = hip.abduction;
  leg.rotation = hip.rotation;
  leg.knee = knee;
  const Matrix3 R_WShank = R_WThigh * TurnY(knee);
  const LimbAngles ankle = AnglesOfLimb(R_WShank.transpose() * target.R_WFoot, sign);
  leg.ankle = ankle.flexion;
  leg.inversion = -ankle.abduction;
  leg.foot_turn = ankle.rotation;
  leg.toes = target.toes_rad;
}

void ReachWith(const Anthropometry& body, int side, const Vector3& p_WHand, BodyPose& pose) {
  const double sign = SideSign(side);
  const BonePoses bones = PlaceBones(body, pose);
  const Matrix3& R_WThorax = bones[kThorax].R;
  const Vector3 reach = p_WHand - bones[kUpperArmL + side].p;
  const auto [elbow, at_shoulder] =
      FoldTo(reach.norm(), body.upper_arm_mm, body.forearm_mm + body.hand_mm / 2);

  // The elbow is below the line to the hand.
  const Vector3 along = reach.normalized();
  const Vector3 pole = R_WThorax * Vector3(0, 0.8 * sign, -1);
  const Vector3 below = (pole - along.dot(pole) * along).normalized();
  const Vector3 upper_down = std::cos(at_shoulder) * along + std::sin(at_shoulder) * below;
  Matrix3 R_WUpper;
  R_WUpper.col(2) = -upper_down;
  R_WUpper.col(0) = std::sin(at_shoulder) * along - std::cos(at_shoulder) * below;
  R_WUpper.col(1) = R_WUpper.col(2).cross(R_WUpper.col(0));

  ArmAngles& arm = pose.arms[side];
  const LimbAngles shoulder = AnglesOfLimb(R_WThorax.transpose() * R_WUpper, sign);
  arm.flexion = shoulder.flexion;
  arm.abduction = shoulder.abduction;
  arm.rotation = shoulder.rotation;
  arm.elbow = elbow;
  arm.pronation = arm.wrist = 0;
}

}  // namespace mocap::simulation
