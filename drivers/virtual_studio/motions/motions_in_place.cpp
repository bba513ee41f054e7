#include "drivers/virtual_studio/motions/motions_in_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "drivers/virtual_studio/curve.h"
#include "drivers/virtual_studio/motions/gait.h"
#include "drivers/virtual_studio/random.h"

namespace mocap::simulation {
namespace {

void PlacePelvis(const Spot& spot, double forward_mm, double left_mm, double pitch, double roll,
                 double yaw, BodyPose& pose) {
  pose.p_WPelvis = spot.At(forward_mm, left_mm, 0);
  pose.R_WPelvis =
      (Eigen::AngleAxisd(spot.yaw + yaw, Vector3::UnitZ()) *
       Eigen::AngleAxisd(pitch, Vector3::UnitY()) * Eigen::AngleAxisd(roll, Vector3::UnitX()))
          .toRotationMatrix();
}

constexpr double kToeOut = 0.14;

class Stand : public Motion {
 public:
  Stand(const Anthropometry& body, const Spot& spot, std::uint64_t seed)
      : body_(body), spot_(spot) {
    Random random(Mix(seed, Tag("stand")));
    for (double& phase : phases_) phase = random.Uniform(0, kTurn);
  }

  BodyPose PoseAt(double t_s) const override {
    const double h = body_.stature_mm;
    const auto sway = [&](int i, double hz) { return std::sin(kTurn * hz * t_s + phases_[i]); };
    const double shift = 0.014 * sway(0, 0.11);
    BodyPose pose;
    PlacePelvis(spot_, (0.012 + 0.004 * sway(1, 0.23)) * h, shift * h, 0.02, 1.2 * shift,
                0.04 * sway(2, 0.13), pose);
    BendTrunk(0.03 + 0.01 * sway(3, 0.27), 1.2 * shift, 0.06 * sway(4, 0.09), 0.3, pose);
    pose.head.twist += 0.35 * sway(5, 0.07);
    pose.head.flexion += 0.06 * sway(6, 0.15);
    for (const int side : {kLeft, kRight}) {
      ArmAngles& arm = pose.arms[side];
      arm.flexion = 0.03 + 0.03 * sway(7 + side, 0.2);
      arm.abduction = 0.38 + 0.05 * sway(9 + side, 0.16);
      arm.elbow = 0.22 + 0.04 * sway(7 + side, 0.24);
      arm.pronation = 0.3;
      arm.wrist = 0.08;
    }
    FollowWithClavicles(pose);
    std::array<FootTarget, 2> feet;
    for (const int side : {kLeft, kRight})
      feet[side] = RollFoot(body_, spot_.At(0, SideSign(side) * 0.068 * h, 0),
                            spot_.yaw - SideSign(side) * kToeOut, 0);
    StandOn(body_, feet, body_.hip_height_mm() - 0.004 * h, pose);
    return pose;
  }

 private:
  Anthropometry body_;
  Spot spot_;
  std::array<double, 11> phases_{};
};

class Jump : public Motion {
 public:
  Jump(const Anthropometry& body, const Spot& spot, std::uint64_t seed) : body_(body), spot_(spot) {
    Random random(Mix(seed, Tag("jump")));
    const double apex_mm = random.Uniform(0.12, 0.16) * body.stature_mm;
    // Smaller people jump faster: times scale with the root of the stature. In units of these
    // times, gravity scales with the stature.
    pace_ = std::sqrt(body.stature_mm / 1750);
    gravity_ = kGravity * pace_ * pace_;
    speed_ = std::sqrt(2 * gravity_ * apex_mm);
    flight_ = 2 * speed_ / gravity_;
    standing_mm_ = body.hip_height_mm() - 0.008 * body.stature_mm;
    on_toes_mm_ = body.hip_height_mm() + 0.022 * body.stature_mm;
  }

  BodyPose PoseAt(double t_s) const override {
    const double landed = kTakeOff + flight_, t = Wrap(t_s / pace_, landed + kLanding);
    const double in_air = t - kTakeOff, h = body_.stature_mm;
    const bool flying = in_air > 0 && in_air < flight_;
    const double crouch = Curve(t, {{{0, 0},
                                     {0.25, 0},
                                     {kDeepest, 1},
                                     {kTakeOff, 0},
                                     {landed, 0.1},
                                     {landed + kAbsorb, 0.9},
                                     {landed + 0.9, 0}}});
    const double heels = Curve(t, {{{0, 0},
                                    {0.75, 0},
                                    {kTakeOff, 0.75},
                                    {landed, 0.5},
                                    {landed + 0.13, 0},
                                    {landed + 0.3, 0},
                                    {landed + 0.9, 0}}});
    const double arms = Curve(t, {{{0, 0},
                                   {0.15, 0},
                                   {0.55, -0.8},
                                   {1.05, 2.4},
                                   {landed, 1.6},
                                   {landed + 0.5, 0.1},
                                   {landed + 0.9, 0}}});
    // The feet are drawn up slightly in the air.
    const double tuck = flying ? std::pow(std::sin(std::numbers::pi * in_air / flight_), 2) : 0;
    // The toes leave the floor and land softly.
    constexpr double kSoft_mm = 20;
    const double fall = gravity_ / 2 * in_air * (flight_ - in_air);
    const double rise = 0.5 * (fall + std::hypot(fall, kSoft_mm));

    BodyPose pose;
    PlacePelvis(spot_, (0.015 - 0.055 * crouch) * h, 0, 0.03 + 0.45 * crouch, 0, 0, pose);
    BendTrunk(0.03 + 0.45 * crouch, 0, 0, 0.9, pose);
    for (ArmAngles& arm : pose.arms) {
      arm.flexion = arms;
      arm.abduction = 0.16;
      arm.elbow = 0.25 + 0.30 * std::pow(std::sin(0.6 * arms), 2);
      arm.rotation = 0.1;
      arm.pronation = 0.2;
    }
    FollowWithClavicles(pose);
    std::array<FootTarget, 2> feet;
    for (const int side : {kLeft, kRight})
      feet[side] = RollFoot(body_, spot_.At(0, SideSign(side) * 0.062 * h, rise + 0.03 * h * tuck),
                            spot_.yaw - SideSign(side) * kToeOut, heels, flying ? 1 - tuck : 1);
    StandOn(body_, feet, HipHeightAt(t), pose);
    return pose;
  }

 private:
  static constexpr double kDeepest = 0.65, kTakeOff = 0.95, kAbsorb = 0.26, kLanding = 1.3;
  static double Curve(double t, const std::array<Key, 7>& keys) { return Evaluate(keys, t); }

  // Down, up with a constant push, free flight, and the same push on landing.
  double HipHeightAt(double t) const {
    const double landed = kTakeOff + flight_;
    const auto pushed = [this](double push, double left) {
      return on_toes_mm_ - speed_ * left * (1 - left / (2 * push));
    };
    constexpr double kPush = kTakeOff - kDeepest;
    if (t < kDeepest)
      return standing_mm_ + (pushed(kPush, kPush) - standing_mm_) * Smoothstep(0.2, kDeepest, t);
    if (t < kTakeOff) return pushed(kPush, kTakeOff - t);
    if (t < landed) return on_toes_mm_ + gravity_ / 2 * (t - kTakeOff) * (landed - t);
    if (t < landed + kAbsorb) return pushed(kAbsorb, t - landed);
    return pushed(kAbsorb, kAbsorb) + (standing_mm_ - pushed(kAbsorb, kAbsorb)) *
                                          Smoothstep(landed + kAbsorb, landed + 0.9, t);
  }

  Anthropometry body_;
  Spot spot_;
  double pace_ = 1, gravity_ = 0, speed_ = 0, flight_ = 0;
  double standing_mm_ = 0, on_toes_mm_ = 0;
};

class Sit : public Motion {
 public:
  /// @param rest_s  time to sit still, without which the person looks around.
  Sit(const Anthropometry& body, const Spot& spot, double rest_s)
      : body_(body), spot_(spot), rest_s_(rest_s), restless_(rest_s > 0 ? 0.03 : 1) {
    seat_mm_ = body.shank_mm + body.ankle_to_sole_mm - 0.040 * body.stature_mm;
  }

  BodyPose PoseAt(double t_s) const override {
    const double h = body_.stature_mm;
    // 1 while seated; leaning forward on the way down and, more, on the way up.
    const std::array<Key, 4> seating = {
        {{1.0, 0}, {2.5, 1}, {4.6 + rest_s_, 1}, {6.0 + rest_s_, 0}}};
    const std::array<Key, 7> leaning = {{{0.8, 0},
                                         {1.8, 0.62},
                                         {2.8, 0.05},
                                         {4.3 + rest_s_, 0.05},
                                         {4.95 + rest_s_, 0.75},
                                         {5.9 + rest_s_, 0.02},
                                         {6.4 + rest_s_, 0}}};
    constexpr double kPeriod_s = 7;
    const double t = Wrap(t_s, kPeriod_s + rest_s_);
    const double seated = Evaluate(seating, t), lean = Evaluate(leaning, t);
    // The pelvis goes back before it goes down.
    const double back = Smoothstep(0, 0.9, seated), down = Smoothstep(0.05, 1, seated);
    const double sitting_mm = seat_mm_ + 0.052 * h;
    const double hip_back = body_.thigh_mm - 0.025 * h;

    BodyPose pose;
    PlacePelvis(spot_, 0.012 * h - (hip_back + 0.012 * h) * back, 0, 0.5 * lean - 0.10 * seated, 0,
                0, pose);
    BendTrunk(0.5 * lean + 0.12 * seated, 0, 0.05 * restless_ * std::sin(0.9 * t_s) * seated, 0.8,
              pose);
    pose.head.twist += 0.25 * restless_ * std::sin(0.6 * t_s);
    for (ArmAngles& arm : pose.arms) {
      arm.flexion = 0.05 + 0.22 * seated + 0.35 * lean;
      arm.abduction = 0.16 + 0.04 * seated;
      arm.elbow = 0.3 + 0.62 * seated;
      arm.rotation = 0.12;
      arm.pronation = 0.25 + 0.6 * seated;
      arm.wrist = 0.1;
    }
    FollowWithClavicles(pose);
    std::array<FootTarget, 2> feet;
    for (const int side : {kLeft, kRight})
      feet[side] = RollFoot(body_, spot_.At(0, SideSign(side) * 0.075 * h, 0),
                            spot_.yaw - SideSign(side) * kToeOut, 0);
    const double standing_mm = body_.hip_height_mm() - 0.006 * h;
    StandOn(body_, feet, standing_mm + (sitting_mm - standing_mm) * down, pose);
    return pose;
  }

  // A seat on four legs: the person is visible between them.
  std::vector<Block> furniture() const override {
    constexpr double kSeatHalf_mm = 165, kThick_mm = 20, kLeg_mm = 14;
    const double middle = -(body_.thigh_mm - 0.025 * body_.stature_mm) + 0.015 * body_.stature_mm;
    const Bgr wood{62, 98, 140};
    std::vector<Block> blocks = {{spot_.At(middle, 0, seat_mm_ - kThick_mm),
                                  {kSeatHalf_mm, kSeatHalf_mm, kThick_mm},
                                  spot_.yaw,
                                  wood,
                                  true}};
    const double leg_half = (seat_mm_ - 2 * kThick_mm) / 2, out = kSeatHalf_mm - kLeg_mm;
    for (const double x : {-out, out})
      for (const double y : {-out, out})
        blocks.push_back({spot_.At(middle + x, y, leg_half),
                          {kLeg_mm, kLeg_mm, leg_half},
                          spot_.yaw,
                          wood,
                          true});
    return blocks;
  }

 private:
  Anthropometry body_;
  Spot spot_;
  double rest_s_, restless_;
  double seat_mm_ = 0;
};

class Step : public Motion {
 public:
  Step(const Anthropometry& body, const Spot& spot)
      : body_(body), spot_(spot), beat_s_(0.85 * std::sqrt(body.stature_mm / 1750)) {
    block_mm_ = 0.11 * body.stature_mm;
    up_mm_ = 0.28 * body.stature_mm;
  }

  BodyPose PoseAt(double t_s) const override {
    // One round: first foot up, second up, rest, first down, second down, rest; then the other
    // foot leads.
    const double round = std::floor(t_s / (6 * beat_s_));
    const double beat = t_s / beat_s_ - 6 * round;
    const int leader = std::fmod(std::abs(round), 2) == 1 ? kRight : kLeft;
    std::array<FootTarget, 2> feet;
    feet[leader] = FootAt(leader, beat, 0.3, 3.3);
    feet[1 - leader] = FootAt(1 - leader, beat, 1.35, 4.35);

    const std::array<Key, 4> forward = {{{0.4, 0}, {2.1, 1}, {3.5, 1}, {5.2, 0}}};
    const std::array<Key, 4> rise = {{{1.1, 0}, {2.2, 1}, {3.4, 1}, {4.3, 0}}};
    const std::array<Key, 6> side = {
        {{0, 0}, {0.6, -1}, {1.7, 1}, {2.6, 0}, {3.7, -0.8}, {5.2, 0}}};
    const double sign = SideSign(leader), h = body_.stature_mm;
    const double shift = 0.022 * h * sign * Evaluate(side, beat);
    const double climbing = Evaluate(rise, beat), moving = std::sin(std::numbers::pi * climbing);
    BodyPose pose;
    PlacePelvis(spot_, up_mm_ * Evaluate(forward, beat) + 0.012 * h, shift, 0.05 + 0.08 * moving, 0,
                0, pose);
    BendTrunk(0.05 + 0.14 * moving, 0, 0, 0.6, pose);
    for (const int k : {kLeft, kRight}) {
      ArmAngles& arm = pose.arms[k];
      arm.flexion = 0.05 + 0.25 * SideSign(k) * sign * Evaluate(side, beat);
      arm.abduction = 0.2 + 0.1 * moving;
      arm.elbow = 0.35 + 0.2 * moving;
      arm.rotation = 0.15;
      arm.pronation = 0.3;
      arm.wrist = 0.1;
    }
    FollowWithClavicles(pose);
    StandOn(body_, feet, body_.hip_height_mm() - 0.006 * h + block_mm_ * climbing, pose);
    return pose;
  }

  std::vector<Block> furniture() const override {
    const double half = 0.105 * body_.stature_mm;
    return {{spot_.At(up_mm_ + 0.03 * body_.stature_mm, 0, block_mm_ / 2),
             {half, 0.19 * body_.stature_mm, block_mm_ / 2},
             spot_.yaw,
             {120, 110, 70},
             false}};
  }

 private:
  // The foot goes up in the beat after `up` and down in the beat after `down`.
  FootTarget FootAt(int side, double beat, double up, double down) const {
    const double rising = beat - up, falling = beat - down, h = body_.stature_mm;
    double way = 0, height = 0, hop = 0;
    if (rising > 0 && falling < 0) {
      way = Smoothstep(0.2, 0.95, rising);
      height = Smoothstep(0, 0.7, rising);
      hop = Smoothstep(0, 0.45, rising) * (1 - Smoothstep(0.55, 0.98, rising));
    } else if (falling >= 0) {
      way = 1 - Smoothstep(0, 0.75, falling);
      height = 1 - Smoothstep(0.35, 1, falling);
      hop = Smoothstep(0, 0.3, falling) * (1 - Smoothstep(0.3, 0.9, falling));
    }
    // Going up, the toes leave the floor last; coming down, they touch it first.
    const std::array<Key, 9> pitch = {{{up - 0.25, 0},
                                       {up + 0.1, 0.7},
                                       {up + 0.55, 0.1},
                                       {up + 0.8, -0.05},
                                       {up + 0.95, 0},
                                       {down - 0.1, 0},
                                       {down + 0.4, 0.25},
                                       {down + 0.95, 0.45},
                                       {down + 1.25, 0}}};
    const Vector3 p =
        spot_.At(up_mm_ * way, SideSign(side) * 0.055 * h, block_mm_ * height + 0.035 * h * hop);
    return RollFoot(body_, p, spot_.yaw - SideSign(side) * 0.1, Evaluate(pitch, beat));
  }

  Anthropometry body_;
  Spot spot_;
  double beat_s_, block_mm_ = 0, up_mm_ = 0;
};

}  // namespace

Vector3 Spot::At(double forward_mm, double left_mm, double z_mm) const {
  const double c = std::cos(yaw), s = std::sin(yaw);
  return {p_W.x() + c * forward_mm - s * left_mm, p_W.y() + s * forward_mm + c * left_mm, z_mm};
}

Spot RandomSpot(std::uint64_t seed) {
  Random random(Mix(seed, Tag("spot")));
  const Vector2 p_W = random.UniformIn({-400, 400}, {-400, 400});
  return {p_W, random.Uniform(0, kTurn)};
}

std::unique_ptr<const Motion> MakeJump(const Anthropometry& body, const Spot& spot,
                                       std::uint64_t seed) {
  return std::make_unique<Jump>(body, spot, seed);
}
std::unique_ptr<const Motion> MakeSit(const Anthropometry& body, const Spot& spot) {
  return std::make_unique<Sit>(body, spot, 0);
}
std::unique_ptr<const Motion> MakeRest(const Anthropometry& body, const Spot& spot) {
  constexpr double kRest_s = 60;
  return std::make_unique<Sit>(body, spot, kRest_s);
}
std::unique_ptr<const Motion> MakeStep(const Anthropometry& body, const Spot& spot) {
  return std::make_unique<Step>(body, spot);
}
std::unique_ptr<const Motion> MakeStand(const Anthropometry& body, const Spot& spot,
                                        std::uint64_t seed) {
  return std::make_unique<Stand>(body, spot, seed);
}

}  // namespace mocap::simulation
