// Pictures as lists, to be compared.
#pragma once

#include <vector>

#include "core/image.h"

namespace mocap {

/// The pixels of a picture, row by row.
inline std::vector<Bgr> Pixels(ImageView<const Bgr> image) {
  std::vector<Bgr> pixels;
  for (int y = 0; y < image.height(); ++y)
    pixels.insert(pixels.end(), image.row(y), image.row(y) + image.width());
  return pixels;
}

}  // namespace mocap
