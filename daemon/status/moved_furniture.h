// Furniture that was moved while the daemon runs, for people.
#pragma once

#include <cstdint>
#include <string>

#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Something that stands in a camera's picture and is no part of its background.
struct MovedFurniture {
  std::string camera;
  std::string place;        ///< Where in the picture: "bottom left, x 8 to 39, y 80 to 111 px".
  double share = 0;         ///< Of the picture.
  std::int64_t age_ns = 0;  ///< How long it has been seen there.
};

/// Says where in a picture a box is.
std::string PlaceInPicture(const PixelBox& box, int width_px, int height_px);

/// Says how large a part of a picture is, as "2.3 %".
std::string ShareText(double share);

}  // namespace mocap
