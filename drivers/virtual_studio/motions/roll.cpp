#include "drivers/virtual_studio/motions/roll.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drivers/virtual_studio/motions/gait.h"
#include "drivers/virtual_studio/people/wheelchair.h"

namespace mocap::simulation {
namespace {

constexpr double kSpeed_mm_s = 700, kPush_s = 1.3;

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

std::unique_ptr<const Motion> MakeRoll(const Anthropometry& body, FloorPath path, double start_mm) {
  return std::make_unique<Roll>(body, std::move(path), start_mm);
}

}  // namespace mocap::simulation
