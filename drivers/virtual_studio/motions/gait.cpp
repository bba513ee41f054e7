#include "drivers/virtual_studio/motions/gait.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mocap::simulation {
namespace {

// Foot against ground over the cycle: Perry and Burnfield, Gait Analysis (2010): contact with the
// heel, flat from a tenth to a third, heel off, toes off at 62 %, clearance, toes up again.
constexpr std::array<Key, 9> kWalkingRoll = {{{0.00, -0.28},
                                              {0.10, 0.00},
                                              {0.30, 0.00},
                                              {0.45, 0.20},
                                              {0.58, 0.65},
                                              {0.66, 0.95},
                                              {0.80, 0.30},
                                              {0.89, -0.15},
                                              {0.96, -0.28}}};
// A jogger's foot lands flat, and the shank folds under the thigh.
constexpr std::array<Key, 9> kRunningRoll = {{{0.00, -0.10},
                                              {0.06, 0.00},
                                              {0.16, 0.00},
                                              {0.28, 0.40},
                                              {0.37, 0.85},
                                              {0.52, 1.45},
                                              {0.70, 0.85},
                                              {0.88, 0.00},
                                              {0.96, -0.10}}};

Matrix3 Turn(const Vector3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

}  // namespace

FootTarget RollFoot(const Anthropometry& body, const Vector3& p_WSole, double yaw, double pitch,
                    double toe_grip, double rounding) {
  // The pivot moves quickly but not instantly from heel to ball: soles and heels are round.
  const double forward = 0.5 + 0.5 * std::tanh(pitch / rounding);
  const double heel = -0.8 * body.heel_mm;
  const Vector3 pivot(heel + (body.ball_mm - heel) * forward, 0, 0.012 * body.stature_mm * forward);
  const Matrix3 R_WYaw = Turn(Vector3::UnitZ(), yaw);
  FootTarget target;
  target.R_WFoot = R_WYaw * Turn(Vector3::UnitY(), pitch);
  target.p_WAnkle =
      p_WSole + R_WYaw * pivot + target.R_WFoot * (Vector3(0, 0, body.ankle_to_sole_mm) - pivot);
  target.toes_rad = toe_grip * pitch * forward;
  // Toes that point down must not penetrate the floor.
  const double toes_mm = body.foot_mm - body.heel_mm - body.ball_mm;
  target.p_WAnkle.z() += toes_mm * std::sin(std::max(0.0, pitch - target.toes_rad)) * forward;
  return target;
}

void StandOn(const Anthropometry& body, const std::array<FootTarget, 2>& feet,
             double wanted_height_mm, BodyPose& pose) {
  constexpr double kSoft_mm = 8;
  const double reach = 0.997 * body.leg_mm();
  double sum = std::exp(0.0);
  for (const int side : {kLeft, kRight}) {
    const Vector3 hip = pose.R_WPelvis * Vector3(0, SideSign(side) * body.hip_half_mm, 0);
    const Vector3& ankle = feet[side].p_WAnkle;
    const double dx = pose.p_WPelvis.x() + hip.x() - ankle.x();
    const double dy = pose.p_WPelvis.y() + hip.y() - ankle.y();
    const double highest =
        ankle.z() + std::sqrt(std::max(0.0, reach * reach - dx * dx - dy * dy)) - hip.z();
    sum += std::exp((wanted_height_mm - highest) / kSoft_mm);
  }
  pose.p_WPelvis.z() = wanted_height_mm - kSoft_mm * std::log(sum);
  for (const int side : {kLeft, kRight}) PlaceLeg(body, side, feet[side], pose);
}

void BendTrunk(double flexion, double bend, double twist, double gaze, BodyPose& pose) {
  pose.lumbar = {0.55 * flexion, 0.5 * bend, 0.35 * twist};
  pose.thorax = {0.45 * flexion, 0.5 * bend, 0.65 * twist};
  pose.neck = {-0.5 * gaze * flexion, -0.4 * gaze * bend, -0.5 * gaze * twist};
  pose.head = {-0.3 * gaze * flexion, -0.3 * gaze * bend, -0.4 * gaze * twist};
}

void FollowWithClavicles(BodyPose& pose) {
  for (ArmAngles& arm : pose.arms) {
    // Elevation: the angle between upper arm and trunk, in any direction.
    const double elevation =
        std::acos(std::clamp(std::cos(arm.flexion) * std::cos(arm.abduction), -1.0, 1.0));
    arm.clavicle_up = 0.28 * std::max(0.0, elevation - 0.3);
    arm.clavicle_forward = 0.15 * std::sin(arm.flexion) * std::cos(arm.abduction);
  }
}

GaitStyle WalkingStyle(const Anthropometry& body) {
  const double h = body.stature_mm;
  GaitStyle style;
  style.step_s = 0.53 * std::sqrt(h / 1750);  // Equal Froude numbers.
  style.full_step_mm = 0.325 * h;
  style.half_width_mm = 0.035 * h;
  style.toe_out = 0.10;
  style.lift_mm = 0.018 * h;
  style.roll = kWalkingRoll;
  style.height_mm = body.hip_height_mm() - 0.008 * h;
  style.sway_mm = 0.012 * h;
  style.hip_yaw = 0.09;
  style.hip_list = 0.06;
  style.lean = 0.06;
  style.arm_swing = 0.40;
  style.arm_out = 0.13 + 0.05 * body.girth;
  style.elbow = 0.35;
  style.elbow_swing = 0.18;
  return style;
}

GaitStyle RunningStyle(const Anthropometry& body) {
  const double h = body.stature_mm;
  GaitStyle style = WalkingStyle(body);
  style.step_s = 0.37 * std::sqrt(h / 1750);
  style.duty = 0.37;
  style.half_width_mm = 0.02 * h;
  style.lift_mm = 0.09 * h;
  style.roll = kRunningRoll;
  style.height_mm = body.hip_height_mm() - 0.014 * h;
  style.bounce_mm = 0.014 * h;
  style.sway_mm = 0.004 * h;
  style.hip_yaw = 0.12;
  style.lean = 0.16;
  style.arm_swing = 0.60;
  style.arm_out = 0.22 + 0.05 * body.girth;
  style.elbow = 1.45;
  style.elbow_swing = 0.25;
  return style;
}

GaitStyle DancingStyle(const Anthropometry& body) {
  const double h = body.stature_mm;
  GaitStyle style = WalkingStyle(body);
  style.step_s = 0.48 * std::sqrt(h / 1750);
  style.half_width_mm = 0.065 * h;
  style.toe_out = 0.22;
  style.lift_mm = 0.045 * h;
  style.height_mm = body.hip_height_mm() - 0.030 * h;
  style.bounce_mm = 0.012 * h;
  style.sway_mm = 0.03 * h;
  style.full_step_mm = 0.2 * h;
  return style;
}

Gait::Gait(const Anthropometry& body, const GaitStyle& style, std::function<Track(double)> track)
    : body_(body), style_(style), track_(std::move(track)) {}

double Gait::PhaseOf(int side, double t_s) const {
  return Wrap(t_s / (2 * style_.step_s) - (side == kLeft ? 0 : 0.5), 1);
}

Gait::Plant Gait::PlantOf(int side, double cycle) const {
  // The foot is placed where the body will be shortly before mid-stance: the heel leaves the ground
  // long before the toes.
  const double contact = (cycle + (side == kLeft ? 0 : 0.5)) * 2 * style_.step_s;
  const Track track = track_(contact + 0.84 * style_.duty * style_.step_s);
  const double sign = SideSign(side);
  const Vector2 left(-std::sin(track.yaw), std::cos(track.yaw));
  const Vector2 p = track.p_W + sign * style_.half_width_mm * left;
  return {Vector3(p.x(), p.y(), 0), track.yaw - sign * style_.toe_out};
}

double Gait::EffortBetween(const Plant& a, const Plant& b) const {
  const double turn_mm = std::abs(b.yaw - a.yaw) * 0.5 * body_.foot_mm;
  const double way = ((b.p_WSole - a.p_WSole).norm() + turn_mm) / (2 * style_.full_step_mm);
  return Smoothstep(0, 1, way);
}

FootTarget Gait::FootAt(int side, double t_s) const {
  const double cycles = t_s / (2 * style_.step_s) - (side == kLeft ? 0 : 0.5);
  const double cycle = std::floor(cycles), phase = cycles - cycle;
  const Plant here = PlantOf(side, cycle), next = PlantOf(side, cycle + 1);
  const double effort_next = EffortBetween(here, next);
  const double effort = phase < 0.2 ? EffortBetween(PlantOf(side, cycle - 1), here) : effort_next;
  const double pitch = effort * Evaluate(style_.roll, phase, 1);
  if (phase < style_.duty) return RollFoot(body_, here.p_WSole, here.yaw, pitch);
  const double u = (phase - style_.duty) / (1 - style_.duty);
  const double way = Smoothstep(0, 1, u);
  Vector3 p = here.p_WSole + way * (next.p_WSole - here.p_WSole);
  const double up = std::sin(std::numbers::pi * u);
  p.z() += std::sqrt(effort) * style_.lift_mm * up * up;
  // In the air the pivot is free; moving it gently spares the knee.
  return RollFoot(body_, p, here.yaw + way * (next.yaw - here.yaw), pitch,
                  1 - Smoothstep(0, 0.5, u), 0.04 + 0.2 * up * up);
}

BodyPose Gait::PoseAt(double t_s) const {
  constexpr double kStep_s = 0.08;
  const Track track = track_(t_s), before = track_(t_s - kStep_s), after = track_(t_s + kStep_s);
  const Vector2 velocity = (after.p_W - before.p_W) / (2 * kStep_s);
  const Vector2 acceleration = (after.p_W - 2 * track.p_W + before.p_W) / (kStep_s * kStep_s);
  const double effort = std::min(1.0, velocity.norm() * style_.step_s / style_.full_step_mm);
  const double phase = PhaseOf(kLeft, t_s), stride = std::cos(kTurn * phase);
  const double stance = std::cos(kTurn * (phase - style_.duty / 2));

  BodyPose pose;
  // Leaning into the curve, the body's weight stays over the feet.
  const Vector2 lean = acceleration / kGravity;
  const Vector2 left(-std::sin(track.yaw), std::cos(track.yaw));
  const Vector2 p = track.p_W + lean * 0.9 * body_.hip_height_mm() +
                    left * style_.sway_mm * stance * (0.4 + 0.6 * effort);
  pose.p_WPelvis << p.x(), p.y(), 0;
  const Vector3 up = Vector3(lean.x(), lean.y(), 1).normalized();
  const Matrix3 R_lean = RotationBetween(Vector3::UnitZ(), up).toRotationMatrix();
  pose.R_WPelvis =
      R_lean * Turn(Vector3::UnitZ(), track.yaw - effort * style_.hip_yaw * stride) *
      Turn(Vector3::UnitY(), 0.4 * effort * style_.lean) *
      Turn(Vector3::UnitX(), effort * style_.hip_list * std::cos(kTurn * (phase - 0.2)));
  BendTrunk(0.6 * effort * style_.lean,
            0.6 * effort * style_.hip_list * std::cos(kTurn * (phase - 0.2)),
            effort * 2.2 * style_.hip_yaw * stride, 1, pose);
  for (const int side : {kLeft, kRight}) {
    const double swing = -SideSign(side) * effort * std::cos(kTurn * (phase - 0.03));
    ArmAngles& arm = pose.arms[side];
    arm.flexion = 0.04 + style_.arm_swing * swing;
    arm.abduction = style_.arm_out;
    arm.elbow = style_.elbow + style_.elbow_swing * swing;
    arm.rotation = 0.25;
    arm.pronation = 0.35;
    arm.wrist = 0.12;
  }
  FollowWithClavicles(pose);
  const double bounce = -std::cos(2 * kTurn * (phase - style_.duty / 2));
  StandOn(body_, {FootAt(kLeft, t_s), FootAt(kRight, t_s)},
          (style_.height_mm + style_.bounce_mm * bounce) * up.z(), pose);
  return pose;
}

}  // namespace mocap::simulation
