// What halving.h means, pixel by pixel.
#pragma once

#include "core/kernels/halving.h"

namespace mocap::kernels::reference {

inline void HalveTiles(const std::uint8_t* from, std::ptrdiff_t stride, int count,
                       const HalvedTiles& to) {
  for (int c = 0; c < 3; ++c) {
    for (int tile = 0; tile < count; ++tile) {
      int sum = 0;
      for (int y = 0; y < kTileRows; ++y) {
        for (int x = tile * kTileSide; x < (tile + 1) * kTileSide; ++x) {
          const std::uint8_t* const top = from + kRowStep_px * y * stride + 6 * x + c;
          to.color[c][y * to.width + x] = MeanOfFour(top, top + stride);
          sum += to.color[c][y * to.width + x];
        }
      }
      to.tile_mean[c][tile] = static_cast<float>(sum) / kTilePixels;
    }
  }
}

inline void AverageTiles(const std::uint8_t* pixels, int width, float* means) {
  for (int i = 0; i < width / kTileSide; ++i) {
    int sum = 0;
    for (int y = 0; y < kTileRows; ++y)
      for (int x = i * kTileSide; x < (i + 1) * kTileSide; ++x) sum += pixels[y * width + x];
    means[i] = static_cast<float>(sum) / kTilePixels;
  }
}

}  // namespace mocap::kernels::reference
