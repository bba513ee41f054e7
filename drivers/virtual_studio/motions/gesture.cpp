#include <array>
#include <cmath>

#include "drivers/virtual_studio/curve.h"
#include "drivers/virtual_studio/motions/gait.h"
#include "drivers/virtual_studio/motions/motions_in_place.h"
#include "drivers/virtual_studio/random.h"

namespace mocap::simulation {
namespace {

constexpr double kGesturePeriod_s = 10;

// Hanging, overhead, before the face, folded before the belly, hanging again.
using Postures = std::array<double, 8>;
constexpr Postures kGestureTimes_s = {0.2, 1.8, 3.2, 4.4, 5.8, 7.0, 8.4, 9.4};
constexpr Postures kArmFlexion = {0.03, 2.75, 2.75, 0.75, 0.75, 0.15, 0.15, 0.03};
constexpr Postures kArmAbduction = {0.3, 0.15, 0.15, 0.12, 0.12, 0.12, 0.12, 0.3};
constexpr Postures kArmRotation = {0.1, 0, 0, 0.5, 0.5, 0.7, 0.7, 0.1};
constexpr Postures kElbowFlexion = {0.2, 0.15, 0.15, 2.35, 2.35, 1.5, 1.5, 0.2};

double AtTime(const Postures& values, double t_s) {
  std::array<Key, 8> keys;
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = {kGestureTimes_s[i], values[i]};
  return Evaluate(keys, Wrap(t_s, kGesturePeriod_s), kGesturePeriod_s);
}

class Gesture : public Motion {
 public:
  Gesture(const Anthropometry& body, const Spot& spot, std::uint64_t seed)
      : body_(body), spot_(spot), phase_(Random(Mix(seed, Tag("gesture"))).Uniform(0, kTurn)) {}

  BodyPose PoseAt(double t_s) const override {
    const double h = body_.stature_mm, sway = std::sin(0.7 * t_s + phase_);
    BodyPose pose;
    pose.p_WPelvis = spot_.At((0.014 + 0.003 * sway) * h, 0.006 * sway * h, 0);
    pose.R_WPelvis =
        Eigen::AngleAxisd(spot_.yaw + 0.05 * sway, Vector3::UnitZ()).toRotationMatrix();
    BendTrunk(0.03, 0, 0.05 * sway, 0.3, pose);
    for (ArmAngles& arm : pose.arms) {
      arm.flexion = AtTime(kArmFlexion, t_s);
      arm.abduction = AtTime(kArmAbduction, t_s);
      arm.rotation = AtTime(kArmRotation, t_s);
      arm.elbow = AtTime(kElbowFlexion, t_s);
      arm.pronation = 0.3;
    }
    FollowWithClavicles(pose);
    std::array<FootTarget, 2> feet;
    for (const int side : {kLeft, kRight})
      feet[side] = RollFoot(body_, spot_.At(0, SideSign(side) * 0.068 * h, 0),
                            spot_.yaw - SideSign(side) * 0.12, 0);
    StandOn(body_, feet, body_.hip_height_mm() - 0.004 * h, pose);
    return pose;
  }

 private:
  Anthropometry body_;
  Spot spot_;
  double phase_;
};

}  // namespace

std::unique_ptr<const Motion> MakeGesture(const Anthropometry& body, const Spot& spot,
                                          std::uint64_t seed) {
  return std::make_unique<Gesture>(body, spot, seed);
}

}  // namespace mocap::simulation
