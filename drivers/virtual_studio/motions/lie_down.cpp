#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "drivers/virtual_studio/curve.h"
#include "drivers/virtual_studio/motions/gait.h"
#include "drivers/virtual_studio/motions/motions_in_place.h"
#include "drivers/virtual_studio/people/person_mesh.h"

namespace mocap::simulation {
namespace {

constexpr double kStanding_s = 1, kLying_s = 60;
constexpr double kDown_s = 4.4;  // From standing to lying.

// Squats, sits down on the floor, rolls onto the back and stretches the legs. Gets up in reverse.
//
// The feet stay in place until the back is on the floor. Both legs move in planes beside the
// middle, in the frame of the spot: x forward from the ankles, z up.
class Lie : public Motion {
 public:
  Lie(const Anthropometry& body, const Spot& spot)
      : body_(body), spot_(spot), pace_(std::sqrt(body.stature_mm / 1750)) {
    // Lying, the middle of the body is over the spot.
    spot_.p_W = spot.At(0.3 * body.stature_mm, 0, 0).head<2>();
    LayOnTheFloor();
  }

  BodyPose PoseAt(double t_s) const override {
    const double lying_s = kLying_s / pace_;
    const double t = Wrap(t_s / pace_, 2 * kStanding_s + 2 * kDown_s + lying_s) - kStanding_s;
    const double u = std::clamp(std::min(t, 2 * kDown_s + lying_s - t), 0.0, kDown_s);
    return PoseDuring(u, Evaluate(raised_mm_, u));
  }

 private:
  // Raises the pelvis where the trunk would sink into the floor.
  void LayOnTheFloor() {
    constexpr int kMoments = 60;
    const PersonMesh mesh = BuildPersonMesh(body_, Outfit{}, 1);
    std::vector<Eigen::Vector3f> p_W, n_W;
    for (int i = 0; i <= kMoments; ++i) {
      const double u = kDown_s * i / kMoments;
      SkinMesh(mesh, PlaceBones(body_, PoseDuring(u, 0)), p_W, n_W);
      double lowest_mm = 0;
      for (const Eigen::Vector3f& p : p_W) lowest_mm = std::min<double>(lowest_mm, p.z());
      raised_mm_.push_back({u, -lowest_mm});
    }
  }

  // @param u  seconds since the person began to lie down, at the pace of an adult.
  BodyPose PoseDuring(double u, double raised_mm) const {
    constexpr std::array<Key, 4> kBack = {{{0, 0.012}, {1.1, -0.13}, {1.8, -0.25}, {4.4, -0.25}}};
    constexpr std::array<Key, 5> kPitch = {
        {{0, 0.03}, {0.8, 0.25}, {1.4, -0.3}, {1.8, -0.75}, {3.3, -std::numbers::pi / 2}}};
    constexpr std::array<Key, 5> kTrunk = {
        {{0, 0.05}, {0.9, 0.6}, {1.8, 0.85}, {2.6, 0.65}, {3.3, 0}}};
    const double h = body_.stature_mm;
    const std::array<Key, 4> height = {{{0, body_.hip_height_mm() - 0.006 * h},
                                        {1.1, 0.24 * h},
                                        {1.8, 0.04 * h},
                                        {4.4, 0.02 * h}}};
    const double back_mm = h * Evaluate(kBack, u), pitch = Evaluate(kPitch, u);
    const double height_mm = Evaluate(height, u) + raised_mm;

    BodyPose pose;
    pose.p_WPelvis = spot_.At(back_mm, 0, height_mm);
    pose.R_WPelvis = (Eigen::AngleAxisd(spot_.yaw, Vector3::UnitZ()) *
                      Eigen::AngleAxisd(pitch, Vector3::UnitY()))
                         .toRotationMatrix();
    BendTrunk(Evaluate(kTrunk, u), 0, 0, 0.5, pose);
    PlaceArms(u, pose);
    const LegAngles leg = LegDuring(u, {back_mm, height_mm}, pitch);
    pose.legs = {leg, leg};
    return pose;
  }

  static void PlaceArms(double u, BodyPose& pose) {
    constexpr std::array<Key, 5> kFlexion = {
        {{0, 0.05}, {1.1, 1.0}, {1.8, 1.3}, {2.6, 1.1}, {3.6, -0.05}}};
    constexpr std::array<Key, 3> kAbduction = {{{0, 0.2}, {1.8, 0.45}, {4.4, 0.5}}};
    constexpr std::array<Key, 3> kElbow = {{{0, 0.25}, {1.4, 0.5}, {4.0, 0.2}}};
    for (ArmAngles& arm : pose.arms) {
      arm.flexion = Evaluate(kFlexion, u);
      arm.abduction = Evaluate(kAbduction, u);
      arm.elbow = Evaluate(kElbow, u);
      arm.pronation = 0.3;
    }
    FollowWithClavicles(pose);
  }

  // @param hip  of a leg, forward and up.
  LegAngles LegDuring(double u, const Vector2& hip, double pelvis_pitch) const {
    constexpr std::array<Key, 2> kForward = {{{2.9, 0}, {4.4, 0.225}}};
    constexpr std::array<Key, 2> kToesUp = {{{3.3, 0}, {4.4, -1}}};
    const double foot_pitch = Evaluate(kToesUp, u), stretched = Smoothstep(2.9, 4.4, u);
    const FootTarget foot =
        RollFoot(body_, {body_.stature_mm * Evaluate(kForward, u), 0, 0}, 0, foot_pitch);
    const Vector2 reach(foot.p_WAnkle.x() - hip.x(), foot.p_WAnkle.z() - hip.y());
    const LimbFold fold = FoldTo(reach.norm(), body_.thigh_mm, body_.shank_mm);
    // From straight down.
    const double thigh = std::atan2(reach.x(), -reach.y()) + fold.at_root;
    LegAngles leg;
    leg.flexion = thigh + pelvis_pitch;
    leg.abduction = 0.1 * stretched;
    leg.rotation = -0.2 * stretched;
    leg.knee = fold.bend;
    leg.ankle = fold.bend - thigh - foot_pitch;
    return leg;
  }

  Anthropometry body_;
  Spot spot_;
  double pace_;
  std::vector<Key> raised_mm_;
};

}  // namespace

std::unique_ptr<const Motion> MakeLie(const Anthropometry& body, const Spot& spot) {
  return std::make_unique<Lie>(body, spot);
}

}  // namespace mocap::simulation
