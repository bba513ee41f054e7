// Beyond the paper: the empty studio, from pictures in which people move about.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/empty_room/shown_colors.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// The empty studio as it was seen before.
struct EarlierRoom {
  Image<Bgr> color;   ///< Smooth, in the present light.
  Silhouette unseen;  ///< Where it was not seen then, either; may be without size.

  bool Knows(int x, int y) const { return unseen.width() == 0 || !unseen.Test(x, y); }
};

/// What pictures of an occupied studio tell about the empty one.
struct EmptyRoom {
  enum class Place : std::uint8_t {
    kSeen,    ///< Its colour is the empty studio's.
    kMoved,   ///< Likewise, but clearly another one than before.
    kUnseen,  ///< No colour was frequent enough.
  };

  Image<Bgr> color;           ///< Smooth; without meaning where it is unseen.
  std::vector<Place> places;  ///< Of each pixel, row by row.

  /// Makes unseen what was moved.
  void ForgetMoved();
  /// Share of pixels that are of a kind.
  double ShareOf(Place place) const;
};

/// Decides for each pixel which colour is the empty studio's: the one that was shown in a quarter
/// of the pictures and twice as often as any other, or in some of them if the studio had it before.
/// Its shades by shadows are no other colours, and the brightest of them counts if it is frequent.
/// What differs clearly from before was moved, and so was what differs slightly beside it.
/// @param earlier  null: unknown.
EmptyRoom FindEmptyRoom(const ShownColors& shown, const EarlierRoom* earlier);

}  // namespace mocap
