#include "core/reconstruction/empty_room/cleared_pictures.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/reconstruction/empty_room/neighbours.h"

namespace mocap {
namespace {

using Place = EmptyRoom::Place;

constexpr float kLevel = 128;  // Units of what is kept.

std::array<std::uint8_t, 3> ValuesOf(const Bgr& color) { return {color.b, color.g, color.r}; }

}  // namespace

ClearedPictures::ClearedPictures(const EmptyRoom& room, const GreyTolerance& tolerance)
    : room_(room),
      tolerance_(tolerance),
      last_(room.places.size()),
      cleared_(room.color.width(), room.color.height()) {
  MOCAP_CHECK(room.ShareOf(Place::kUnseen) < 1);
  FindNearest();
}

// Spreads from the pixels that are seen to their neighbours.
void ClearedPictures::FindNearest() {
  constexpr std::size_t kNone = ~std::size_t{0};
  nearest_.assign(last_.size(), kNone);
  std::vector<std::size_t> reached;
  for (std::size_t i = 0; i < nearest_.size(); ++i) {
    if (room_.places[i] == Place::kUnseen) continue;
    nearest_[i] = i;
    reached.push_back(i);
  }
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const std::size_t from = reached[next];
    ForEachNeighbour(from, cleared_.width(), cleared_.height(), [&](std::size_t to) {
      if (nearest_[to] != kNone) return;
      nearest_[to] = nearest_[from];
      reached.push_back(to);
    });
  }
}

void ClearedPictures::Note(ImageView<const Bgr> picture, const SteadyPicture& steady) {
  MOCAP_CHECK(picture.width() == cleared_.width() && picture.height() == cleared_.height());
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * picture.width() + x;
      if (room_.places[i] == Place::kUnseen ||
          !tolerance_.Accepts(room_.color.pixels()[i], steady.color.pixels()[i]))
        continue;
      const std::array<std::uint8_t, 3> values = ValuesOf(picture(x, y));
      for (int c = 0; c < 3; ++c) {
        last_[i][c] = static_cast<std::uint16_t>(
            std::clamp(std::lround(values[c] / steady.light[c] * kLevel), 0L, 65535L));
      }
    }
  }
}

const Image<Bgr>& ClearedPictures::Clear(ImageView<const Bgr> picture, const SteadyPicture& steady,
                                         const Image<Bgr>* filling) {
  Note(picture, steady);
  const auto lit = [&](double value, int c) {
    return static_cast<std::uint8_t>(std::min(std::lround(value * steady.light[c]), 255L));
  };
  for (std::size_t i = 0; i < last_.size(); ++i) {
    const bool is_filled = filling && room_.places[i] == Place::kUnseen;
    const std::array<std::uint16_t, 3>& last = last_[nearest_[i]];
    const Bgr fill = is_filled ? filling->pixels()[i] : Bgr{};
    cleared_.pixels()[i] = is_filled ? Bgr{lit(fill.b, 0), lit(fill.g, 1), lit(fill.r, 2)}
                                     : Bgr{lit(last[0] / kLevel, 0), lit(last[1] / kLevel, 1),
                                           lit(last[2] / kLevel, 2)};
  }
  return cleared_;
}

}  // namespace mocap
