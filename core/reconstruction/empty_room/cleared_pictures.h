// Beyond the paper: pictures of the empty studio, made of those of an occupied one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/empty_room/empty_room.h"
#include "core/reconstruction/empty_room/steady_picture.h"

namespace mocap {

/// Replaces whatever is not the empty studio in pictures of one camera, by the same place at the
/// last moment at which it was empty. So the variation learned from these pictures is the camera's.
/// Thread-bound.
class ClearedPictures {
 public:
  /// @param room  borrowed. Not all of it is unseen.
  ClearedPictures(const EmptyRoom& room, const GreyTolerance& tolerance);

  /// Takes what a picture shows of the empty studio. Call it for all pictures before the first is
  /// cleared.
  /// @param steady  of the picture.
  void Note(ImageView<const Bgr> picture, const SteadyPicture& steady);

  /// Clears a picture. Call it for all pictures, in the order of their times.
  /// @param filling  the studio where it is unseen, in the first picture's light; null: the nearest
  /// pixel that was seen.
  /// @return  valid until the next call.
  const Image<Bgr>& Clear(ImageView<const Bgr> picture, const SteadyPicture& steady,
                          const Image<Bgr>* filling);

 private:
  void FindNearest();

  const EmptyRoom& room_;
  const GreyTolerance tolerance_;
  /// Each pixel when its place was empty last, in the first picture's light [grey levels / 128].
  std::vector<std::array<std::uint16_t, 3>> last_;
  std::vector<std::size_t> nearest_;  ///< For each pixel, the nearest one that is seen.
  Image<Bgr> cleared_;
};

}  // namespace mocap
