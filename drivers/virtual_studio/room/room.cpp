#include "drivers/virtual_studio/room/room.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "drivers/virtual_studio/random.h"
#include "drivers/virtual_studio/room/room_plan.h"

namespace mocap::simulation {
namespace {

using Vector2f = Eigen::Vector2f;
using Vector3f = Eigen::Vector3f;

constexpr float kHalfX = kRoomX_mm / 2, kHalfY = kRoomY_mm / 2, kTop = kRoomZ_mm;

Vector3f ColorOf(Bgr c) { return {float(c.b), float(c.g), float(c.r)}; }

// Loss of light near an edge between two surfaces.
float EdgeShade(float distance_mm, float depth, float reach_mm) {
  // Below half a grey level, skip the exponential.
  if (distance_mm > 5 * reach_mm) return 1;
  return 1 - depth * std::exp(-std::max(distance_mm, 0.0f) / reach_mm);
}

// std::floor is a function call on machines without SSE4.
int Floor(float v) {
  const int i = static_cast<int>(v);
  return i - (v < static_cast<float>(i) ? 1 : 0);
}

bool Odd(float v) { return (Floor(v) & 1) != 0; }

// Where a ray from inside leaves a box: the axis of the face, and its sign in `positive`.
struct Exit {
  float distance;
  int axis;
  bool positive;
};

Exit LeaveBox(const Vector3f& origin, const Vector3f& direction, const Vector3f& low,
              const Vector3f& high) {
  Exit exit{std::numeric_limits<float>::max(), 0, false};
  for (int axis = 0; axis < 3; ++axis) {
    const bool positive = direction[axis] > 0;
    if (direction[axis] == 0) continue;
    const float t = ((positive ? high[axis] : low[axis]) - origin[axis]) / direction[axis];
    if (t < exit.distance) exit = {t, axis, positive};
  }
  return exit;
}

}  // namespace

NoiseTexture::NoiseTexture(std::uint64_t seed) {
  Random random(Mix(seed, Tag("noise")));
  cells_.resize(256 * 256);
  for (float& cell : cells_) cell = static_cast<float>(random.Uniform(-1, 1));
}

float NoiseTexture::At(float x, float y) const {
  const int i = Floor(x), j = Floor(y);
  const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
  const int x0 = i & 255, x1 = (i + 1) & 255;
  const int y0 = (j & 255) * 256, y1 = ((j + 1) & 255) * 256;
  const float su = u * u * (3 - 2 * u), sv = v * v * (3 - 2 * v);
  const float a = cells_[y0 + x0] + su * (cells_[y0 + x1] - cells_[y0 + x0]);
  const float b = cells_[y1 + x0] + su * (cells_[y1 + x1] - cells_[y1 + x0]);
  return a + sv * (b - a);
}

float NoiseTexture::Rough(float x, float y) const {
  return 0.55f * At(x, y) + 0.3f * At(2.1f * x + 37, 2.1f * y) +
         0.15f * At(4.3f * x, 4.3f * y + 91);
}

Room::Room(std::uint64_t seed, const std::vector<Block>& furniture) : noise_(seed) {
  Random random(Mix(seed, Tag("room")));
  const double base = random.Uniform(105, 150);
  for (Vector3f& color : wall_colors_) {
    const double tint = random.Uniform(-10, 10), value = base + random.Uniform(-8, 8);
    color = Vector3f(float(value - tint), float(value), float(value + tint));
  }
  wall_ = {static_cast<std::uint8_t>(wall_colors_[0].x()),
           static_cast<std::uint8_t>(wall_colors_[0].y()),
           static_cast<std::uint8_t>(wall_colors_[0].z())};
  const double floor = random.Uniform(85, 125);
  floor_color_ = Vector3f(float(floor * 0.80), float(floor * 0.92), float(floor * 1.05));
  rug_color_ = random.UniformIn({60, 130}, {60, 130}, {60, 130}).cast<float>();
  rug_center_ = random.UniformIn({-900, 900}, {-900, 900}).cast<float>();
  rug_half_ = random.UniformIn({500, 900}, {400, 700}).cast<float>();
  AddPosters(seed);
  AddThings(seed, furniture);
}

void Room::AddPosters(std::uint64_t seed) {
  Random random(Mix(seed, Tag("poster")));
  const auto color = [&]() -> Vector3f {
    return random.UniformIn({40, 200}, {40, 200}, {40, 200}).cast<float>();
  };
  for (int wall = 0; wall < 4; ++wall) {
    // The wall with the door has space on one side only.
    const int count = wall == 0 ? 2 : 3;
    for (int i = 0; i < count; ++i) {
      Poster poster;
      poster.wall = wall;
      const double across = wall == 0 ? -2400 + 1500 * i : -2000 + 2000 * i;
      const Vector2 center = random.UniformIn({-250, 250}, {1250, 1750}) + Vector2(across, 0);
      poster.center = center.cast<float>();
      poster.half = random.UniformIn({180, 420}, {180, 380}).cast<float>();
      poster.first = color();
      poster.second = 0.6f * poster.first + 0.4f * color();
      poster.pattern = static_cast<int>(random.Bits() % 4);
      poster.cell_mm = float(random.Uniform(50, 130));
      posters_.push_back(poster);
    }
  }
}

void Room::AddThings(std::uint64_t seed, const std::vector<Block>& furniture) {
  Random random(Mix(seed, Tag("thing")));
  std::vector<Block> blocks = furniture;
  const auto grey = [&](double low, double high) {
    const double v = random.Uniform(low, high);
    return Bgr{static_cast<std::uint8_t>(v), static_cast<std::uint8_t>(v * 0.97),
               static_cast<std::uint8_t>(v * 0.94)};
  };
  blocks.push_back(
      {{kHalfX - 240, random.Uniform(-1900, -700), 450}, {220, 480, 450}, 0, {70, 105, 145}, true});
  blocks.push_back(
      {{random.Uniform(600, 1600), kHalfY - 300, 620}, {350, 250, 620}, 0, grey(80, 150), false});
  blocks.push_back({{random.Uniform(-1500, 300), -kHalfY + 320, 240},
                    {300, 240, 240},
                    random.Uniform(-0.4, 0.4),
                    {60, 70, 150},
                    false});
  blocks.push_back({{-kHalfX + 260, random.Uniform(-2200, -1200), 330},
                    {200, 330, 330},
                    0,
                    grey(60, 120),
                    true});
  for (const Block& block : blocks)
    things_.push_back({block, block.center_W.cast<float>(), block.half_mm.cast<float>(),
                       ColorOf(block.color), static_cast<float>(std::cos(block.yaw)),
                       static_cast<float>(std::sin(block.yaw))});
}

Vector3f Room::FloorColor(const Vector3f& p) const {
  const Vector2f on_rug = (p.head<2>() - rug_center_).cwiseAbs() - rug_half_;
  Vector3f color;
  if (on_rug.maxCoeff() < 0) {
    const bool stripe = Odd((p.x() - rug_center_.x()) / 110);
    color = rug_color_ * (stripe ? 0.82f : 1.0f) * (1 + 0.06f * noise_.At(p.x() / 9, p.y() / 9));
  } else {
    // Boards of 180 mm along x, each with its own tone and grain, with joints 4 mm wide.
    const float board = static_cast<float>(Floor(p.y() / 180));
    const float across = p.y() - 180 * board;
    color = floor_color_ * (1 + 0.10f * noise_.At(board * 7.3f, 0.5f) +
                            0.09f * noise_.Rough(p.x() / 260 + board * 17, p.y() / 22));
    if (across < 4) color *= 0.72f;
  }
  const float edge = std::min(kHalfX - std::abs(p.x()), kHalfY - std::abs(p.y()));
  float shade = EdgeShade(edge, 0.3f, 220) * (1 + 0.04f * noise_.Rough(p.x() / 700, p.y() / 700));
  for (const Thing& thing : things_) {
    const Vector2f d = p.head<2>() - thing.center.head<2>();
    const Vector2f local(thing.cosine * d.x() + thing.sine * d.y(),
                         -thing.sine * d.x() + thing.cosine * d.y());
    const Vector2f out = (local.cwiseAbs() - thing.half.head<2>()).cwiseMax(0.0f);
    const float gap = std::max(thing.center.z() - thing.half.z(), 0.0f);
    const float near = out.norm() + gap;
    if (near < 500) shade *= EdgeShade(near, 0.35f, 90);
  }
  return color * shade;
}

Vector3f Room::WallColor(int wall, const Vector3f& p) const {
  const float across = wall < 2 ? p.y() : p.x();
  const float half = wall < 2 ? kHalfY : kHalfX;
  Vector3f color =
      wall_colors_[wall] * (1 + 0.05f * noise_.Rough(across / 420 + 50 * wall, p.z() / 420) +
                            0.025f * noise_.At(across / 14, p.z() / 14 + 31 * wall));
  for (const Poster& poster : posters_) {
    if (poster.wall != wall) continue;
    const Vector2f d = Vector2f(across, p.z()) - poster.center;
    const Vector2f in = poster.half - d.cwiseAbs();
    if (in.minCoeff() < 0) continue;
    const float c = poster.cell_mm;
    bool second = false;
    if (poster.pattern == 0) second = Odd(d.x() / c) != Odd(d.y() / c);
    if (poster.pattern == 1) second = Odd((d.x() + d.y()) / c);
    if (poster.pattern == 2) second = noise_.Rough(d.x() / c, d.y() / c + 17 * wall) > 0.05f;
    if (poster.pattern == 3) second = Odd(d.norm() / c);
    color = second ? poster.second : poster.first;
    if (in.minCoeff() < 14) color *= 0.35f;
  }
  if (p.z() < 90) color = Vector3f::Constant(70);
  const float edge = std::min({half - std::abs(across), p.z() + 40, kTop - p.z()});
  return color * EdgeShade(edge, 0.25f, 260) * (0.86f + 0.10f * p.z() / kTop);
}

Vector3f Room::CeilingColor(const Vector3f& p) const {
  // Light panels in a ceiling of mineral boards.
  const bool panel =
      std::abs(std::abs(p.x()) - 1500) < 300 && std::abs(std::abs(p.y()) - 1300) < 600;
  if (panel) return Vector3f::Constant(238);
  const bool joint = std::fmod(p.x() + 6000, 600.0f) < 12 || std::fmod(p.y() + 6000, 600.0f) < 12;
  return Vector3f::Constant(joint ? 118.0f : 150.0f) *
         (1 + 0.03f * noise_.At(p.x() / 20, p.y() / 20));
}

bool Room::CastCorridor(const Vector3f& origin, const Vector3f& direction, Hit& hit) const {
  constexpr float kX = kDoorX_mm, kJamb = kDoorX_mm - kDoorJamb_mm;
  const Vector3f low(kJamb, kDoorY_mm - kDoorWidth_mm / 2, 0);
  const Vector3f high(kX + 1, kDoorY_mm + kDoorWidth_mm / 2, kDoorHeight_mm);
  const Vector3f p = origin + hit.distance * direction;
  if (p.y() < low.y() || p.y() > high.y() || p.z() > high.z()) return false;
  Exit exit = LeaveBox(origin, direction, low, high);
  const bool jamb = !(exit.axis == 0 && !exit.positive);
  if (!jamb)
    exit = LeaveBox(origin, direction,
                    Vector3f(kJamb - kCorridorDepth_mm, kDoorY_mm - kCorridorHalfLength_mm, 0),
                    Vector3f(kJamb, kDoorY_mm + kCorridorHalfLength_mm, 2500));
  hit.distance = exit.distance;
  const Vector3f q = origin + exit.distance * direction;
  hit.on_floor = exit.axis == 2 && !exit.positive;
  if (hit.on_floor)
    hit.bgr = 0.6f * floor_color_ * (1 + 0.08f * noise_.Rough(q.x() / 200, q.y() / 40));
  else
    hit.bgr = wall_colors_[2] * (jamb ? 0.8f : 0.55f) *
              (1 + 0.05f * noise_.Rough((q.x() + q.y()) / 300, q.z() / 300));
  return true;
}

void Room::CastThings(const Vector3f& origin, const Vector3f& direction, Hit& hit) const {
  for (const Thing& thing : things_) {
    const auto turned = [&](const Vector3f& v) {
      return Vector3f(thing.cosine * v.x() + thing.sine * v.y(),
                      -thing.sine * v.x() + thing.cosine * v.y(), v.z());
    };
    const Vector3f o = turned(origin - thing.center), d = turned(direction);
    float enter = 0, leave = hit.distance;
    int axis = -1;
    for (int i = 0; i < 3 && enter < leave; ++i) {
      if (d[i] == 0) {
        if (std::abs(o[i]) > thing.half[i]) leave = -1;
        continue;
      }
      const float inverse = 1 / d[i];
      const float middle = -o[i] * inverse, reach = thing.half[i] * std::abs(inverse);
      if (middle - reach > enter) enter = middle - reach, axis = i;
      leave = std::min(leave, middle + reach);
    }
    if (enter >= leave || axis < 0) continue;
    const Vector3f p = o + enter * d;
    const float side = axis == 2 ? 1.1f : (axis == 0 ? 0.82f : 0.92f);
    const float u = axis == 0 ? p.y() : p.x(), v = axis == 2 ? p.y() : p.z();
    const float grain = thing.block.grained ? 0.16f * noise_.Rough(u / 300, v / 16)
                                            : 0.05f * noise_.Rough(u / 90, v / 90);
    const float rim = std::min(thing.half.x() - std::abs(u), 400.0f) < 6 ? 0.85f : 1.0f;
    hit = {enter, thing.color * side * (1 + grain) * rim, false};
  }
}

Room::Hit Room::Cast(const Vector3f& origin, const Vector3f& direction) const {
  const Exit exit =
      LeaveBox(origin, direction, Vector3f(-kHalfX, -kHalfY, 0), Vector3f(kHalfX, kHalfY, kTop));
  Hit hit{exit.distance, Vector3f::Zero(), exit.axis == 2 && !exit.positive};
  const bool to_door = exit.axis == 0 && !exit.positive && CastCorridor(origin, direction, hit);
  // Colours cost most. Intersect all objects first, then colour only what is visible.
  const float surface = hit.distance;
  CastThings(origin, direction, hit);
  if (to_door || hit.distance < surface) return hit;
  const Vector3f p = origin + hit.distance * direction;
  if (exit.axis == 2)
    hit.bgr = exit.positive ? CeilingColor(p) : FloorColor(p);
  else
    hit.bgr = WallColor(2 * exit.axis + (exit.positive ? 1 : 0), p);
  return hit;
}

}  // namespace mocap::simulation
