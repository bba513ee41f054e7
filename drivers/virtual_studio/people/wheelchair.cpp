#include "drivers/virtual_studio/people/wheelchair.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drivers/virtual_studio/motions/gait.h"
#include "drivers/virtual_studio/people/tube_builder.h"

namespace mocap::simulation {
namespace {

constexpr double kSpeed_mm_s = 700, kPush_s = 1.3;
constexpr double kTyre_mm = 14;  // Half its thickness.

// A tube or box of the chair, in the pelvis's frame.
Ring ChairRing(const TubeBuilder& builder, const RigidTransform& X_PRing, double half_x_mm,
               double half_y_mm) {
  Ring ring;
  ring.X_WRing = builder.rest()[kPelvis] * X_PRing;
  ring.section.front = ring.section.back = half_x_mm;
  ring.section.outer = ring.section.inner = half_y_mm;
  ring.weights[kPelvis] = 1;
  return ring;
}

void AddBox(const Vector3& middle_P, const Vector3& half_mm, TubeBuilder& builder) {
  builder.AddTube(1, -1, PlainStyle(kLoad, 4, 16), [&](double s) {
    Ring ring = ChairRing(builder, {Matrix3::Identity(), middle_P + Vector3(0, 0, s * half_mm.z())},
                          half_mm.x(), half_mm.y());
    ring.roundness = 5;
    return ring;
  });
}

// A tyre: one sees through the wheel.
void AddTyre(const Vector3& axle_P, const Wheelchair& chair, TubeBuilder& builder) {
  constexpr double kAlmostAround = 0.999;
  builder.AddTube(0, kAlmostAround, PlainStyle(kLoad, 36, 8), [&](double s) {
    const double c = std::cos(kTurn * s), d = std::sin(kTurn * s);
    Matrix3 R_PRing;
    R_PRing << d, 0, -c,  //
        0, 1, 0,          //
        c, 0, d;
    const Vector3 p_P = axle_P + (chair.wheel_radius_mm - kTyre_mm) * Vector3(d, 0, c);
    return ChairRing(builder, {R_PRing, p_P}, kTyre_mm, kTyre_mm);
  });
}

class Roll : public Motion {
 public:
  Roll(const Anthropometry& body, FloorPath path, double start_mm)
      : body_(body), chair_(FitWheelchair(body)), path_(std::move(path)), start_mm_(start_mm) {}

  BodyPose PoseAt(double t_s) const override {
    const double way_mm = kSpeed_mm_s * t_s + start_mm_, yaw = path_.HeadingAt(way_mm);
    const Vector2 p = path_.PositionAt(way_mm);
    const RigidTransform X_WFloor = {Eigen::AngleAxisd(yaw, Vector3::UnitZ()).toRotationMatrix(),
                                     {p.x(), p.y(), 0}};
    const double phase = kTurn * t_s / kPush_s;

    BodyPose pose;
    pose.R_WPelvis = X_WFloor.R;
    pose.p_WPelvis = X_WFloor * Vector3(0, 0, chair_.hips_mm);
    BendTrunk(0.14 + 0.08 * std::sin(phase), 0, 0, 0.9, pose);
    for (const int side : {kLeft, kRight}) {
      const Vector3 sole(chair_.feet_forward_mm, SideSign(side) * 0.055 * body_.stature_mm,
                         chair_.footrest_mm);
      PlaceLeg(body_, side, RollFoot(body_, X_WFloor * sole, yaw, 0), pose);
      PushWith(side, X_WFloor * HandAt(side, phase), pose);
    }
    return pose;
  }

 private:
  // The hand pushes the top of the tyre forward, and returns above it.
  Vector3 HandAt(int side, double phase) const {
    const double angle = 0.35 + 0.40 * std::sin(phase);
    const double radius_mm = chair_.wheel_radius_mm + 0.014 * body_.stature_mm -
                             0.012 * body_.stature_mm * std::cos(phase);
    return {chair_.axle_forward_mm + radius_mm * std::sin(angle),
            SideSign(side) * chair_.wheel_out_mm,
            chair_.wheel_radius_mm + radius_mm * std::cos(angle)};
  }

  // Bends an arm towards a point with the elbow behind, as those who push wheels do.
  void PushWith(int side, const Vector3& p_WHand, BodyPose& pose) const {
    const BonePoses bones = PlaceBones(body_, pose);
    const Vector3 reach = bones[kThorax].R.transpose() * (p_WHand - bones[kUpperArmL + side].p);
    const LimbFold fold =
        FoldTo(reach.norm(), body_.upper_arm_mm, body_.forearm_mm + body_.hand_mm / 2);
    ArmAngles& arm = pose.arms[side];
    arm.flexion = std::atan2(reach.x(), -reach.z()) - fold.at_root;
    arm.abduction = std::max(std::asin(SideSign(side) * reach.y() / reach.norm()), 0.0);
    arm.elbow = fold.bend;
  }

  Anthropometry body_;
  Wheelchair chair_;
  FloorPath path_;
  double start_mm_;
};

}  // namespace

Wheelchair FitWheelchair(const Anthropometry& body) {
  const double h = body.stature_mm;
  Wheelchair chair;
  chair.footrest_mm = 0.03 * h;
  chair.hips_mm = chair.footrest_mm + body.ankle_to_sole_mm + 0.94 * body.shank_mm;
  chair.wheel_radius_mm = 0.158 * h;
  chair.axle_forward_mm = 0.02 * h;
  chair.wheel_out_mm = (0.125 + 0.015 * std::max(body.girth, 0.0)) * h;
  chair.feet_forward_mm = 0.97 * body.thigh_mm + 0.1 * body.shank_mm;
  return chair;
}

void AddWheelchair(const Anthropometry& body, TubeBuilder& builder) {
  const Wheelchair chair = FitWheelchair(body);
  const double h = body.stature_mm, seat_half = chair.wheel_out_mm - 2 * kTyre_mm;
  constexpr double kPlate_mm = 15;
  const double seat_mm = -0.052 * h - kPlate_mm;  // Below the thighs.
  AddBox({0.38 * body.thigh_mm, 0, seat_mm}, {0.5 * body.thigh_mm, seat_half, kPlate_mm}, builder);
  AddBox({-0.085 * h, 0, 0.09 * h}, {kPlate_mm, seat_half, 0.15 * h}, builder);
  AddBox({chair.feet_forward_mm + 0.03 * h, 0, chair.footrest_mm - kPlate_mm - chair.hips_mm},
         {0.07 * h, 0.09 * h, kPlate_mm}, builder);
  const double front_mm = 0.88 * body.thigh_mm, low_mm = chair.footrest_mm - chair.hips_mm;
  for (const double side : {1.0, -1.0}) {
    AddTyre(
        {chair.axle_forward_mm, side * chair.wheel_out_mm, chair.wheel_radius_mm - chair.hips_mm},
        chair, builder);
    AddBox({front_mm, side * 0.09 * h, 0.5 * (seat_mm + low_mm)},
           {kTyre_mm, kTyre_mm, 0.5 * (seat_mm - low_mm)}, builder);
  }
}

std::unique_ptr<const Motion> MakeRoll(const Anthropometry& body, FloorPath path, double start_mm) {
  return std::make_unique<Roll>(body, std::move(path), start_mm);
}

}  // namespace mocap::simulation
