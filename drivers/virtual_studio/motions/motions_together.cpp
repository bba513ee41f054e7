#include "drivers/virtual_studio/motions/motions_together.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/virtual_studio/curve.h"
#include "drivers/virtual_studio/motions/gait.h"
#include "drivers/virtual_studio/random.h"

namespace mocap::simulation {
namespace {

double Between(double from, double to, double share) { return from + share * (to - from); }

ArmAngles Between(const ArmAngles& from, const ArmAngles& to, double share) {
  return {Between(from.clavicle_up, to.clavicle_up, share),
          Between(from.clavicle_forward, to.clavicle_forward, share),
          Between(from.flexion, to.flexion, share),
          Between(from.abduction, to.abduction, share),
          Between(from.rotation, to.rotation, share),
          Between(from.elbow, to.elbow, share),
          Between(from.pronation, to.pronation, share),
          Between(from.wrist, to.wrist, share)};
}

class Greeting : public Motion {
 public:
  Greeting(const Anthropometry& body, const Meeting& meeting, bool second)
      : body_(body),
        meeting_(meeting),
        facing_rad_(meeting.line_rad + (second ? std::numbers::pi : 0)),
        walk_{meeting.walk_mm, meeting.speed_mm_s, kEase_s},
        gait_(body, WalkingStyle(body), [this](double t_s) { return TrackAt(t_s); }) {}

  BodyPose PoseAt(double t_s) const override {
    BodyPose pose = gait_.PoseAt(t_s);
    const double clasped_s = Within(t_s) - walk_.duration_s();
    // Only when the place is within reach: an arm straightens suddenly.
    const double reach = Smoothstep(-0.2, 0.6, clasped_s) * (1 - Smoothstep(2.3, 3.0, clasped_s));
    if (reach == 0) return pose;
    BodyPose reaching = pose;
    ArmAngles& arm = reaching.arms[kRight];
    arm = {.clavicle_up = 0.08, .clavicle_forward = 0.1};
    ReachWith(body_, kRight, HandAt(clasped_s), reaching);
    pose.arms[kRight] = Between(pose.arms[kRight], arm, reach);
    return pose;
  }

 private:
  static constexpr double kEase_s = 0.8, kClasp_s = 3, kTurning_s = 3;
  // Half the distance of two touching palms.
  static constexpr double kPalm_mm = 14;

  double Round_s() const { return 2 * (walk_.duration_s() + kTurning_s) + kClasp_s; }
  double Within(double t_s) const { return Wrap(t_s - meeting_.begin_s, Round_s()); }

  // The middle of the hand: palm against palm, moving up and down.
  Vector3 HandAt(double clasped_s) const {
    const double shake_mm = 20 * std::sin(kTurn * 2.2 * clasped_s);
    const Vector2 right(std::sin(facing_rad_), -std::cos(facing_rad_));
    const Vector2 p = meeting_.p_W + kPalm_mm * right;
    return {p.x(), p.y(), meeting_.hands_mm + shake_mm};
  }

  // Walks there, turns, walks back, turns.
  Track TrackAt(double t_s) const {
    const double walk_s = walk_.duration_s(), t = Within(t_s);
    const double leaving_s = walk_s + kClasp_s, home_s = leaving_s + kTurning_s + walk_s;
    const double there = walk_.WayAt(t) - walk_.WayAt(t - leaving_s - kTurning_s);
    const double turned = Smoothstep(leaving_s, leaving_s + kTurning_s, t) +
                          Smoothstep(home_s, home_s + kTurning_s, t);
    const double away_mm = StandOff_mm() + meeting_.walk_mm - there;
    const Vector2 ahead(std::cos(facing_rad_), std::sin(facing_rad_));
    const double before = kTurn * std::round((t_s - meeting_.begin_s - t) / Round_s());
    // Offset to the left, so that the right arms are in line.
    const Vector2 left(-ahead.y(), ahead.x());
    const Vector2 p = meeting_.p_W - away_mm * ahead + 0.05 * body_.stature_mm * left;
    return {p, facing_rad_ + before + std::numbers::pi * turned};
  }

  double StandOff_mm() const { return 0.25 * body_.stature_mm; }

  Anthropometry body_;
  Meeting meeting_;
  double facing_rad_;
  EasedWalk walk_;
  Gait gait_;
};

class RingDance : public Motion {
 public:
  RingDance(const Anthropometry& body, const DanceRing& ring, int place)
      : body_(body),
        place_rad_(kTurn * place / ring.dancers),
        radius_mm_(ring.spacing_mm / (2 * std::sin(std::numbers::pi / ring.dancers))),
        start_rad_(Random(Mix(ring.seed, Tag("ring"))).Uniform(0, kTurn)),
        own_rad_(Random(Mix(ring.seed, Tag("dancer"), static_cast<std::uint64_t>(place)))
                     .Uniform(0, kTurn)),
        gait_(body, DancingStyle(body), [this](double t_s) { return TrackAt(t_s); }) {}

  BodyPose PoseAt(double t_s) const override {
    BodyPose pose = gait_.PoseAt(t_s);
    const double beat = kTurn * t_s / (4 * DancingStyle(body_).step_s) + own_rad_;
    BendTrunk(0.05 + 0.05 * std::sin(beat), 0.12 * std::sin(beat + 1.1),
              0.35 * std::sin(beat + 0.4), 0.8, pose);
    for (const int side : {kLeft, kRight}) {
      const double sign = SideSign(side), wave = std::sin(beat + sign * 0.8);
      ArmAngles& arm = pose.arms[side];
      arm.abduction = 0.35 + 0.15 * wave;
      arm.flexion = 0.05 + 0.15 * std::sin(beat - sign * 0.7);
      arm.rotation = 0.2 * std::sin(beat + sign);
      arm.elbow = 2.2 + 0.2 * std::sin(beat + 0.5 + sign * 1.2);
      arm.pronation = 0.3 + 0.3 * std::sin(beat * 0.5 + sign);
      arm.wrist = 0.2 * std::sin(beat + 2);
    }
    FollowWithClavicles(pose);
    return pose;
  }

 private:
  Track TrackAt(double t_s) const {
    const double around = start_rad_ + place_rad_ + 0.3 * t_s + 0.25 * std::sin(0.4 * t_s);
    const Vector2 middle(250 * std::sin(0.21 * t_s + start_rad_), 250 * std::cos(0.17 * t_s));
    const Vector2 out(std::cos(around), std::sin(around));
    return {middle + radius_mm_ * out,
            around + std::numbers::pi + 0.25 * std::sin(0.45 * t_s + own_rad_)};
  }

  Anthropometry body_;
  double place_rad_, radius_mm_, start_rad_, own_rad_;
  Gait gait_;
};

}  // namespace

Meeting PlanMeeting(const std::array<Anthropometry, 2>& bodies, const Vector2& p_W, double line_rad,
                    double begin_s) {
  const double stature_mm = (bodies[0].stature_mm + bodies[1].stature_mm) / 2;
  return {.p_W = p_W,
          .line_rad = line_rad,
          .hands_mm = 0.6 * stature_mm,
          .walk_mm = 1150,
          .speed_mm_s = 1000 * std::sqrt(stature_mm / 1750),
          .begin_s = begin_s};
}

std::unique_ptr<const Motion> MakeGreeting(const Anthropometry& body, const Meeting& meeting,
                                           bool second) {
  return std::make_unique<Greeting>(body, meeting, second);
}
std::unique_ptr<const Motion> MakeDanceInRing(const Anthropometry& body, const DanceRing& ring,
                                              int place) {
  return std::make_unique<RingDance>(body, ring, place);
}

}  // namespace mocap::simulation
