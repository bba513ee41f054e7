#include "core/reconstruction/empty_room/empty_room.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "core/reconstruction/empty_room/neighbours.h"

namespace mocap {
namespace {

using Place = EmptyRoom::Place;
using Color = ShownColors::Color;

/// A colour is the empty studio's if it was shown in this share of the pictures, and this many
/// times as often as the next. A person who leaves a place sooner is not taken for a wall.
constexpr double kLeastShare = 0.25;
constexpr int kDominance = 2;
/// A brighter shade is the unshaded one if it was shown in this share of the pictures of a darker.
constexpr double kLeastUnshaded = 0.5;
/// Shadows leave at least this share of the light.
constexpr double kDarkestShade = 0.4;
/// With the studio's earlier colour, this many pictures are enough.
constexpr int kFewestOfKnown = 8;
/// A smaller difference from before is a change of light [grey levels].
constexpr int kMovedDifference = 20;
/// But beside what was moved or never settled, this is part of it: somebody who sits there has
/// places of the wall's colour, and throws a shadow [grey levels].
constexpr int kSlightDifference = 6;

int DifferenceOf(const Bgr& a, const Bgr& b) {
  return std::max({std::abs(a.b - b.b), std::abs(a.g - b.g), std::abs(a.r - b.r)});
}

bool HasMoved(const Bgr& earlier, const Bgr& now) {
  return DifferenceOf(earlier, now) > kMovedDifference;
}

/// The colour that is nearest to the earlier one, if it was shown.
std::optional<Color> KnownAmong(const std::array<Color, ShownColors::kColors>& colors,
                                const Bgr& earlier) {
  std::optional<Color> nearest;
  for (const Color& color : colors) {
    if (color.pictures < kFewestOfKnown || HasMoved(earlier, color.mean)) continue;
    if (!nearest || DifferenceOf(earlier, color.mean) < DifferenceOf(earlier, nearest->mean))
      nearest = color;
  }
  return nearest;
}

/// Whether one colour is the other one in a shadow: darker, with the same tint.
bool IsShadeOf(const Bgr& dark, const Bgr& bright, const GreyTolerance& tolerance) {
  const double share =
      static_cast<double>(dark.b + dark.g + dark.r) / std::max(bright.b + bright.g + bright.r, 1);
  if (share >= 1 || share < kDarkestShade) return false;
  const auto shaded = [share](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::lround(share * value));
  };
  return tolerance.Accepts({shaded(bright.b), shaded(bright.g), shaded(bright.r)}, dark);
}

/// The colour that was shown clearly most often, if there is one.
std::optional<Color> ClearAmong(const std::array<Color, ShownColors::kColors>& colors,
                                const ShownColors& shown) {
  Color clear = colors[0];
  for (const Color& other : colors) {
    if (other.pictures >= kLeastUnshaded * clear.pictures &&
        IsShadeOf(clear.mean, other.mean, shown.tolerance()))
      clear = other;
  }
  if (clear.pictures < kLeastShare * shown.pictures()) return std::nullopt;
  for (const Color& other : colors) {
    if (other.mean == clear.mean || kDominance * other.pictures <= clear.pictures) continue;
    if (!IsShadeOf(other.mean, clear.mean, shown.tolerance())) return std::nullopt;
  }
  return clear;
}

/// Adds to what was moved, and to what is unseen, what differs slightly beside it.
void Spread(const EarlierRoom& earlier, EmptyRoom& room) {
  const int width = earlier.color.width(), height = earlier.color.height();
  std::vector<std::size_t> reached;
  for (std::size_t i = 0; i < room.places.size(); ++i)
    if (room.places[i] != Place::kSeen) reached.push_back(i);
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const std::size_t from = reached[next];
    ForEachNeighbour(from, width, height, [&](std::size_t to) {
      const int x = static_cast<int>(to) % width, y = static_cast<int>(to) / width;
      if (room.places[to] != Place::kSeen || !earlier.Knows(x, y) ||
          DifferenceOf(earlier.color(x, y), room.color(x, y)) <= kSlightDifference)
        return;
      room.places[to] = Place::kMoved;
      reached.push_back(to);
    });
  }
}

}  // namespace

double EmptyRoom::ShareOf(Place place) const {
  return static_cast<double>(std::ranges::count(places, place)) /
         static_cast<double>(places.size());
}

void EmptyRoom::ForgetMoved() { std::ranges::replace(places, Place::kMoved, Place::kUnseen); }

EmptyRoom FindEmptyRoom(const ShownColors& shown, const EarlierRoom* earlier) {
  EmptyRoom room{Image<Bgr>(shown.width(), shown.height()), {}};
  room.places.resize(room.color.pixels().size(), Place::kUnseen);
  for (std::size_t i = 0; i < room.places.size(); ++i) {
    const std::array<Color, ShownColors::kColors> colors = shown.At(i);
    std::optional<Color> settled = ClearAmong(colors, shown);
    Place place = Place::kSeen;
    const int x = static_cast<int>(i) % shown.width(), y = static_cast<int>(i) / shown.width();
    const bool is_known = earlier && earlier->Knows(x, y);
    if (is_known && (!settled || HasMoved(earlier->color(x, y), settled->mean))) {
      const std::optional<Color> known = KnownAmong(colors, earlier->color(x, y));
      if (!known) place = Place::kMoved;
      if (known) settled = known;
    }
    if (!settled) continue;
    room.color.pixels()[i] = settled->mean;
    room.places[i] = place;
  }
  if (earlier) Spread(*earlier, room);
  return room;
}

}  // namespace mocap
