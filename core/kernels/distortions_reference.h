// What distortions.h means, pixel by pixel.
#pragma once

#include "core/kernels/distortions.h"

namespace mocap::kernels::reference {

inline void MeasureDistortions(const WeighedPixels* groups, int group_step,
                               ImageView<const Bgr> band, const std::array<float, 3>& gain,
                               const DistortionRows& to) {
  constexpr int kPixels = WeighedPixels::kPixels;
  for (int y = 0; y < band.height(); ++y) {
    for (int x = 0; x < band.width(); ++x) {
      const WeighedPixels& group = groups[x / kPixels * group_step + y];
      const int k = x % kPixels, i = y * to.row_step + x;
      const std::array<std::uint8_t, 3> live = {band(x, y).b, band(x, y).g, band(x, y).r};
      std::array<float, 3> m, z, w;
      for (int c = 0; c < 3; ++c) {
        w[c] = group.inverse_sigma[c][k] * WeighedPixels::kInverseSigmaUnit;
        m[c] = group.mean[c][k] * (WeighedPixels::kMeanUnit * w[c]);
        z[c] = gain[c] * live[c] * w[c];
      }
      const float alpha =
          (z[0] * m[0] + z[1] * m[1] + z[2] * m[2]) / (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
      std::array<float, 3> cd;
      for (int c = 0; c < 3; ++c) to.cd[c][i] = cd[c] = z[c] - alpha * m[c];
      to.alpha_shift[i] = alpha - 1;
      to.cd_sq[i] = cd[0] * cd[0] + cd[1] * cd[1] + cd[2] * cd[2];
      to.alpha_weight[i] = group.alpha_weight[k] * WeighedPixels::kAlphaWeightUnit;
      to.inverse_sigma[i] = w[1];
    }
  }
}

}  // namespace mocap::kernels::reference
