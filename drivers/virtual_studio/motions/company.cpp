#include "drivers/virtual_studio/motions/company.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"
#include "drivers/virtual_studio/curve.h"
#include "drivers/virtual_studio/motions/motions_in_place.h"
#include "drivers/virtual_studio/motions/motions_together.h"
#include "drivers/virtual_studio/motions/path_walker.h"
#include "drivers/virtual_studio/motions/roll.h"
#include "drivers/virtual_studio/random.h"
#include "drivers/virtual_studio/room/room_plan.h"

namespace mocap::simulation {
namespace {

using Bodies = std::span<const Anthropometry>;
using Motions = std::vector<std::unique_ptr<const Motion>>;

double MeanStature(Bodies bodies) {
  double sum = 0;
  for (const Anthropometry& body : bodies) sum += body.stature_mm;
  return sum / static_cast<double>(bodies.size());
}

// All have the same speed, so that nobody catches up.
double CommonSpeed(Bodies bodies, double speed_mm_s) {
  return speed_mm_s * std::sqrt(MeanStature(bodies) / 1750);
}

Spot SpotFacing(const Vector2& p_W, const Vector2& to_W) {
  const Vector2 ahead = to_W - p_W;
  return {p_W, std::atan2(ahead.y(), ahead.x())};
}

// All walk on one figure-eight path and pass its middle in turns.
Motions Cross(Bodies bodies, std::uint64_t seed) {
  // The loops give each person arm's length, and fit into the room.
  constexpr double kMostRadius_mm = 820;
  const auto count = static_cast<double>(bodies.size());
  const double size_mm = MeanStature(bodies);
  const double radius_mm = std::min(std::max(0.4, 0.115 * count) * size_mm, kMostRadius_mm);
  Random random(Mix(seed, Tag("cross")));
  const FloorPath path = FigureEight(Vector2::Zero(), radius_mm, random.Uniform(0, kTurn));
  const double start_mm = random.Uniform(0, path.length_mm());
  const double loop_mm = path.length_mm() / 2;
  const double apart_mm = std::min(size_mm * random.Uniform(0.72, 0.85), loop_mm / count);
  Motions motions;
  for (const Anthropometry& body : bodies) {
    // Successive people are on different loops.
    const auto place = static_cast<double>(motions.size());
    const double other_mm = motions.size() % 2 == 1 ? loop_mm : 0;
    motions.push_back(std::make_unique<PathWalker>(body, WalkingStyle(body), path,
                                                   CommonSpeed(bodies, 1000),
                                                   start_mm + place * apart_mm + other_mm));
  }
  return motions;
}

// One after the other around the middle.
template <typename Make>
void AddAround(Bodies bodies, double radius_mm, std::uint64_t seed, Motions& motions, Make make) {
  const FloorPath path = OvalPath(Vector2::Zero(), radius_mm, seed);
  const double apart_mm = path.length_mm() / static_cast<double>(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    motions.push_back(make(bodies[i], path, apart_mm * static_cast<double>(i)));
}

void AddRound(Bodies bodies, GaitStyle (*style)(const Anthropometry&), double radius_mm,
              double speed_mm_s, std::uint64_t seed, Motions& motions) {
  AddAround(bodies, radius_mm, seed, motions,
            [&](const Anthropometry& body, const FloorPath& path, double start_mm) {
              return std::make_unique<PathWalker>(body, style(body), path,
                                                  CommonSpeed(bodies, speed_mm_s), start_mm);
            });
}

Motions Run(Bodies bodies, std::uint64_t seed) {
  Motions motions;
  AddRound(bodies, RunningStyle, 1500, 1700, seed, motions);
  return motions;
}

Motions RollAround(Bodies bodies, std::uint64_t seed) {
  Motions motions;
  AddAround(bodies, kRollRadius_mm, seed, motions, MakeRoll);
  return motions;
}

Motions DanceTogether(Bodies bodies, std::uint64_t seed) {
  const DanceRing ring{
      .dancers = static_cast<int>(bodies.size()),
      .spacing_mm = 0.6 * std::ranges::max(bodies, {}, &Anthropometry::stature_mm).stature_mm,
      .seed = seed};
  Motions motions;
  for (int i = 0; i < ring.dancers; ++i) motions.push_back(MakeDanceInRing(bodies[i], ring, i));
  return motions;
}

// @param make  for the first person, who sits.
Motions SitAmong(Bodies bodies, std::uint64_t seed, decltype(MakeSit) make) {
  const double direction = Random(Mix(seed, Tag("seat"))).Uniform(0, kTurn);
  // The thighs are over the middle of the room.
  const Vector2 ahead(std::cos(direction), std::sin(direction));
  Motions motions;
  motions.push_back(make(bodies[0], {bodies[0].thigh_mm / 2 * ahead, direction}));
  AddRound(bodies.subspan(1), WalkingStyle, 1450, 1080, seed, motions);
  return motions;
}

Motions LieAmong(Bodies bodies, std::uint64_t seed) {
  const double direction = Random(Mix(seed, Tag("floor"))).Uniform(0, kTurn);
  Motions motions;
  motions.push_back(MakeLie(bodies[0], {Vector2::Zero(), direction}));
  AddRound(bodies.subspan(1), WalkingStyle, 1500, 1080, seed, motions);
  return motions;
}

Motions StandInDoorway(Bodies bodies, std::uint64_t seed) {
  Motions motions;
  motions.push_back(MakeStand(bodies[0], {Vector2(kDoorX_mm - 25, kDoorY_mm), 0}, seed));
  AddRound(bodies.subspan(1), WalkingStyle, 1450, 1080, seed, motions);
  return motions;
}

// Through the door, around the room, out again, and out of sight behind the corridor back to the
// start.
std::vector<Vector2> VisitorsRound() {
  const double x = kDoorX_mm - kDoorJamb_mm - 0.5 * kCorridorDepth_mm;
  constexpr double kTurn_mm = 850;
  const double far_x = x - 2 * kTurn_mm, y0 = kDoorY_mm - kHidingPlace_mm,
               y1 = kDoorY_mm + kHidingPlace_mm;
  return {{x, y0},
          {x, kDoorY_mm - 900},
          {x + 200, kDoorY_mm - 250},
          {kDoorX_mm - 150, kDoorY_mm - 60},
          {kDoorX_mm + 700, kDoorY_mm - 150},
          {-1000, -800},
          {300, -1450},
          {1450, -200},
          {750, 1300},
          {-900, 1250},
          {kDoorX_mm + 700, kDoorY_mm + 50},
          {kDoorX_mm - 150, kDoorY_mm + 60},
          {x + 200, kDoorY_mm + 250},
          {x, kDoorY_mm + 900},
          {x, y1},
          {x - kTurn_mm, y1 + kTurn_mm},
          {far_x, y1},
          {far_x, y0},
          {x - kTurn_mm, y0 - kTurn_mm}};
}

// Where a path that begins outside enters and leaves the room.
struct Inside {
  double enter_mm = 0, leave_mm = 0;
};

Inside InsideOf(const FloorPath& path) {
  constexpr double kStep_mm = 10;
  Inside inside;
  for (double s = 0; s < path.length_mm(); s += kStep_mm) {
    if (path.PositionAt(s).x() < kDoorX_mm) continue;
    if (inside.enter_mm == 0) inside.enter_mm = s;
    inside.leave_mm = s;
  }
  return inside;
}

Motions VisitThoseWhoStay(Bodies bodies, std::uint64_t seed) {
  Random random(Mix(seed, Tag("visitors")));
  const std::size_t staying = bodies.size() / 2;
  const Vector2 middle(200, 0), aside(0, staying > 1 ? 450 : 0);
  Motions motions;
  for (std::size_t i = 0; i < staying; ++i) {
    const Vector2 p_W = i == 0 ? Vector2(middle + aside) : Vector2(middle - aside);
    const Spot spot = staying > 1 ? SpotFacing(p_W, middle) : Spot{p_W, random.Uniform(0, kTurn)};
    motions.push_back(MakeStand(bodies[i], spot, Mix(seed, i)));
  }
  const FloorPath path = RoundPath(VisitorsRound());
  const Inside inside = InsideOf(path);
  const double speed_mm_s = CommonSpeed(bodies, 1050), first_s = random.Uniform(2.5, 4);
  // Nobody enters while another leaves.
  const double apart_mm =
      (inside.leave_mm - inside.enter_mm) / static_cast<double>(bodies.size() - staying);
  for (std::size_t i = staying; i < bodies.size(); ++i)
    motions.push_back(std::make_unique<PathWalker>(
        bodies[i], WalkingStyle(bodies[i]), path, speed_mm_s,
        inside.enter_mm - speed_mm_s * first_s - apart_mm * static_cast<double>(i - staying)));
  return motions;
}

Motions Meet(Bodies bodies, std::uint64_t seed) {
  Random random(Mix(seed, Tag("meet")));
  const double line_rad = random.Uniform(0, kTurn);
  const Vector2 across(-std::sin(line_rad), std::cos(line_rad));
  // Side by side, if there is more than one pair or a bystander.
  const double aside_mm = bodies.size() > 2 ? 700 : random.Uniform(-300, 300);
  Motions motions;
  for (std::size_t i = 0; i + 1 < bodies.size(); i += 2) {
    const Vector2 p_W = (i == 0 ? aside_mm : -aside_mm) * across;
    const Meeting meeting =
        PlanMeeting({bodies[i], bodies[i + 1]}, p_W, line_rad, random.Uniform(-3, 0.5));
    for (const bool second : {false, true})
      motions.push_back(MakeGreeting(bodies[i + (second ? 1 : 0)], meeting, second));
  }
  if (bodies.size() % 2 == 1)
    motions.push_back(MakeStand(bodies.back(), SpotFacing(-aside_mm * across, aside_mm * across),
                                Mix(seed, bodies.size())));
  return motions;
}

// In places around the middle; nobody faces another.
Spot StandingPlace(std::size_t place, std::size_t people, std::uint64_t seed) {
  constexpr double kApart_mm = 1500;
  const auto count = static_cast<double>(people);
  const double around = Random(Mix(seed, Tag("places"))).Uniform(0, kTurn) +
                        kTurn * static_cast<double>(place) / count;
  const double radius_mm = kApart_mm / (2 * std::sin(std::numbers::pi / count));
  return {radius_mm * Vector2(std::cos(around), std::sin(around)), around + kTurn / 4};
}

template <typename Make>
Motions InPlaces(Bodies bodies, std::uint64_t seed, Make make) {
  Motions motions;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    motions.push_back(make(bodies[i], StandingPlace(i, bodies.size(), seed), Mix(seed, i)));
  return motions;
}

}  // namespace

std::vector<std::unique_ptr<const Motion>> MakeCompany(std::string_view name, Bodies bodies,
                                                       std::uint64_t seed) {
  if (bodies.size() == 1) {
    if (name == "meet" || name == "doorway")
      throw SetupError("motion " + Quoted(name) + " needs 2 people or more; people is 1");
    Motions motions;
    motions.push_back(MakeMotion(name, bodies[0], seed));
    return motions;
  }
  if (name == "walk") return Cross(bodies, seed);
  if (name == "run") return Run(bodies, seed);
  if (name == "roll") return RollAround(bodies, seed);
  if (name == "dance") return DanceTogether(bodies, seed);
  if (name == "sit") return SitAmong(bodies, seed, MakeSit);
  if (name == "rest") return SitAmong(bodies, seed, MakeRest);
  if (name == "lie") return LieAmong(bodies, seed);
  if (name == "doorway") return StandInDoorway(bodies, seed);
  if (name == "visit") return VisitThoseWhoStay(bodies, seed);
  if (name == "meet") return Meet(bodies, seed);
  if (name == "jump") return InPlaces(bodies, seed, MakeJump);
  if (name == "stand") return InPlaces(bodies, seed, MakeStand);
  if (name == "gesture") return InPlaces(bodies, seed, MakeGesture);
  if (name == "step")
    return InPlaces(bodies, seed, [](const Anthropometry& body, const Spot& spot, std::uint64_t) {
      return MakeStep(body, spot);
    });
  const std::vector<std::string> names(kCompanyMotionNames.begin(), kCompanyMotionNames.end());
  throw SetupError("motion " + Quoted(name) + " is unknown; " + ExpectedNames(name, names));
}

}  // namespace mocap::simulation
