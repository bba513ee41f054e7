#include "drivers/virtual_studio/motions/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"
#include "drivers/virtual_studio/curve.h"
#include "drivers/virtual_studio/motions/gait.h"
#include "drivers/virtual_studio/motions/motions_in_place.h"
#include "drivers/virtual_studio/motions/path_walker.h"
#include "drivers/virtual_studio/motions/roll.h"
#include "drivers/virtual_studio/random.h"
#include "drivers/virtual_studio/room/room_plan.h"

namespace mocap::simulation {
namespace {

// Steps from side to side with a twisting waist and raised arms.
class Dance : public Motion {
 public:
  Dance(const Anthropometry& body, std::uint64_t seed)
      : body_(body),
        seed_phase_(Random(Mix(seed, Tag("dance"))).Uniform(0, kTurn)),
        gait_(body, DancingStyle(body), [this](double t_s) { return TrackAt(t_s); }) {}

  BodyPose PoseAt(double t_s) const override {
    BodyPose pose = gait_.PoseAt(t_s);
    const double beat = kTurn * t_s / (4 * DancingStyle(body_).step_s);
    const double slow = 0.31 * t_s + seed_phase_;
    BendTrunk(0.10 + 0.10 * std::sin(beat), 0.14 * std::sin(beat + 1.1),
              0.55 * std::sin(beat + 0.4), 0.8, pose);
    const double raised = 0.5 + 0.5 * std::sin(slow * 2.1);
    for (const int side : {kLeft, kRight}) {
      const double sign = SideSign(side);
      ArmAngles& arm = pose.arms[side];
      const double wave = std::sin(beat + sign * 0.8 + slow);
      arm.abduction =
          0.45 + 1.75 * Smoothstep(0, 1, raised + 0.15 * sign * std::sin(slow)) + 0.25 * wave;
      arm.flexion = 0.35 + 0.35 * std::sin(beat - sign * 0.7);
      arm.rotation = 0.3 * std::sin(beat + sign);
      arm.elbow = 0.75 + 0.45 * std::sin(beat + 0.5 + sign * 1.2);
      arm.pronation = 0.3 + 0.4 * std::sin(beat * 0.5 + sign);
      arm.wrist = 0.3 * std::sin(beat + 2);
    }
    FollowWithClavicles(pose);
    return pose;
  }

 private:
  Track TrackAt(double t_s) const {
    const double a = 0.55 * t_s + seed_phase_;
    const double reach = 0.16 * body_.stature_mm;
    Track track;
    track.p_W = Vector2(1.6 * reach * std::sin(a) + 250 * std::sin(0.21 * t_s),
                        reach * std::sin(1.7 * a + 1) + 250 * std::cos(0.17 * t_s));
    track.yaw = seed_phase_ + 0.8 * std::sin(0.45 * t_s) + 0.12 * t_s;
    return track;
  }

  Anthropometry body_;
  double seed_phase_;
  Gait gait_;
};

// Comes in through the door, walks around and leaves; then again in reverse.
class Visit : public Motion {
 public:
  Visit(const Anthropometry& body, std::uint64_t seed)
      : path_(SplinePath(Waypoints(seed))),
        walk_{path_.length_mm(), 1050 * std::sqrt(body.stature_mm / 1750), kEase_s},
        gait_(body, WalkingStyle(body), [this](double t_s) { return TrackAt(t_s); }) {}
  BodyPose PoseAt(double t_s) const override { return gait_.PoseAt(t_s); }

 private:
  static constexpr double kHidden_s = 3, kEase_s = 0.8;

  static std::vector<Vector2> Waypoints(std::uint64_t seed) {
    Random random(Mix(seed, Tag("visit")));
    const double x = kDoorX_mm - kDoorJamb_mm - 0.5 * kCorridorDepth_mm;
    const double r = random.Uniform(0.9, 1.1);
    return {{x, kDoorY_mm - kHidingPlace_mm},
            {x, kDoorY_mm - 900},
            {x + 200, kDoorY_mm - 250},
            {kDoorX_mm - 150, kDoorY_mm - 60},
            {kDoorX_mm + 700, kDoorY_mm - 150},
            {-900 * r, -700 * r},
            {300 * r, -1350 * r},
            {1350 * r, -200 * r},
            {700 * r, 1200 * r},
            {-800 * r, 1150 * r},
            {kDoorX_mm + 700, kDoorY_mm + 50},
            {kDoorX_mm - 150, kDoorY_mm + 60},
            {x + 200, kDoorY_mm + 250},
            {x, kDoorY_mm + 900},
            {x, kDoorY_mm + kHidingPlace_mm}};
  }

  Track TrackAt(double t_s) const {
    const double walk_s = walk_.duration_s();
    const double visit_s = walk_s + kHidden_s;
    const double visit = std::floor(t_s / visit_s);
    const double u = t_s - visit * visit_s;
    const bool back = std::fmod(std::abs(visit), 2) == 1;
    const double waiting = 0.5 * kHidden_s;
    const double distance = walk_.WayAt(u - waiting);
    // Out of sight, the person turns on the spot.
    const double turned = u < waiting ? -0.5 * (1 - Smoothstep(0, waiting, u))
                                      : 0.5 * Smoothstep(waiting + walk_s, visit_s, u);
    const double s = back ? path_.length_mm() - distance : distance;
    const double heading =
        path_.HeadingAt(s) + (back ? std::numbers::pi : 0) + kTurn * std::floor(visit / 2);
    return {path_.PositionAt(s), heading + std::numbers::pi * turned};
  }

  FloorPath path_;
  EasedWalk walk_;
  Gait gait_;
};

}  // namespace

std::unique_ptr<const Motion> MakeMotion(std::string_view name, const Anthropometry& body,
                                         std::uint64_t seed) {
  const double pace = std::sqrt(body.stature_mm / 1750);
  if (name == "walk")
    return std::make_unique<PathWalker>(body, WalkingStyle(body),
                                        OvalPath(Vector2::Zero(), 1250, seed), 1080 * pace);
  if (name == "run")
    return std::make_unique<PathWalker>(body, RunningStyle(body),
                                        OvalPath(Vector2::Zero(), 1500, seed), 1700 * pace);
  if (name == "roll") return MakeRoll(body, OvalPath(Vector2::Zero(), kRollRadius_mm, seed));
  if (name == "dance") return std::make_unique<Dance>(body, seed);
  if (name == "visit") return std::make_unique<Visit>(body, seed);
  if (name == "jump") return MakeJump(body, RandomSpot(seed), seed);
  if (name == "sit") return MakeSit(body, RandomSpot(seed));
  if (name == "rest") return MakeRest(body, RandomSpot(seed));
  if (name == "lie") return MakeLie(body, RandomSpot(seed));
  if (name == "step") return MakeStep(body, RandomSpot(seed));
  if (name == "stand") return MakeStand(body, RandomSpot(seed), seed);
  if (name == "gesture") return MakeGesture(body, RandomSpot(seed), seed);
  const std::vector<std::string> names(kMotionNames.begin(), kMotionNames.end());
  throw SetupError("motion " + Quoted(name) + " is unknown; " + ExpectedNames(name, names));
}

}  // namespace mocap::simulation
