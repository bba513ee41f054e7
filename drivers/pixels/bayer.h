// Colour out of a sensor behind a mosaic of filters.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/image.h"

namespace mocap {

/// Where a Bayer pattern has its red pixel, in the first two rows and columns.
struct BayerOrder {
  int red_x = 0, red_y = 0;
};

/// Interpolates the colours that a pixel's filter took away from its nearest neighbours; beyond the
/// border the picture is mirrored.
/// @pre  width and height are at least 2; out has the same size.
void InterpolateBayer(ImageView<const std::uint8_t> mosaic, BayerOrder order, Image<Bgr>& out);

}  // namespace mocap
