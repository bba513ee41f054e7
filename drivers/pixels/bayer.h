// Interpolation of Bayer mosaics to colour pictures.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/image.h"

namespace mocap {

/// Position of the red pixel within the first two rows and columns of a Bayer pattern.
struct BayerOrder {
  int red_x = 0, red_y = 0;
};

/// Interpolates the missing colours of each pixel from its nearest neighbours. Beyond the border
/// the picture is mirrored.
/// @pre  width and height are at least 2; out has the same size.
void InterpolateBayer(ImageView<const std::uint8_t> mosaic, BayerOrder order, Image<Bgr>& out);

}  // namespace mocap
