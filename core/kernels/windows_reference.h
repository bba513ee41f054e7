// What windows.h means, pixel by pixel.
#pragma once

#include <algorithm>

#include "core/kernels/windows.h"

namespace mocap::kernels::reference {

/// Sums term(value, distance to the right) over the width of a window.
template <typename Term>
float SumAcross(const float* value, std::size_t window, const Term& term) {
  const int smaller = kWindowRadii_px[0];
  float sum = 0;
  for (int i = smaller; i >= -smaller; --i) sum = term(value[i], i) + sum;
  if (window == 0) return sum;
  const int larger = kWindowRadii_px[1];
  return sum + term(value[-larger], -larger) + term(value[larger], larger);
}

inline void SumAlongLines(const float* alpha_shift, const std::array<const float*, 3>& cd,
                          int row_step, int blocks, int rows, BlockSums* sums) {
  const auto itself = [](float value, int) { return value; };
  const auto square = [](float value, int) { return value * value; };
  const auto moment = [](float value, int to_right) {
    return value * static_cast<float>(to_right);
  };
  for (int row = 0; row < rows; ++row) {
    for (int x = 0; x < blocks * kBlock_px; ++x) {
      const int i = row * row_step + x, k = x % kBlock_px;
      for (std::size_t window = 0; window < kWindows; ++window) {
        LineSums& to = sums[x / kBlock_px * kSumLines + row][window];
        to.alpha[k] = SumAcross(alpha_shift + i, window, itself);
        to.alpha_sq[k] = SumAcross(alpha_shift + i, window, square);
        to.moment[k] = SumAcross(alpha_shift + i, window, moment);
        for (int c = 0; c < 3; ++c) to.cd[c][k] = SumAcross(cd[c] + i, window, itself);
      }
    }
  }
}

/// Deviation of a window.
struct WindowDistortion {
  float alpha_shift;   ///< Mean of α − 1.
  float cd_sq;         ///< Squared length of the mean colour distance.
  float roughness_sq;  ///< Variance of α about a plane, divided by a².
};

/// Measures the window around pixel `x` of a row of a pair.
inline WindowDistortion MeasureWindow(const DistortionRowPair& pair, int row, int x,
                                      std::size_t window) {
  const int radius = kWindowRadii_px[window], k = x % kBlock_px;
  const auto line_at = [&](int below_first) -> const LineSums& {
    return pair.sums[below_first + kLargestRadius_px][x / kBlock_px * kSumLines][window];
  };
  float alpha = 0, alpha_sq = 0, along = 0, down = 0;
  std::array<float, 3> cd{};
  const auto add = [&](const LineSums& line, float below, bool is_first) {
    const auto add_to = [&](float& sum, float value) { sum = is_first ? value : sum + value; };
    add_to(alpha, line.alpha[k]), add_to(alpha_sq, line.alpha_sq[k]);
    add_to(along, line.moment[k]), add_to(down, below * line.alpha[k]);
    for (int c = 0; c < 3; ++c) add_to(cd[c], line.cd[c][k]);
  };
  // The lines that both rows share, from the lowest up and from the middle between the rows.
  for (int i = radius; i > -radius; --i) add(line_at(i), static_cast<float>(i) - 0.5f, i == radius);
  down -= (row == 0 ? -0.5f : 0.5f) * alpha;
  if (row == 0) {
    add(line_at(-radius), static_cast<float>(-radius), false);
  } else {
    add(line_at(radius + 1), static_cast<float>(radius), false);
  }
  const auto side = static_cast<float>(2 * radius + 1);
  const float area = side * side;
  const float spread = area * (area - 1) / 12;
  const float weight = pair.rows[row].alpha_weight[x];
  WindowDistortion result;
  result.alpha_shift = alpha * (1 / area);
  const float squares =
      alpha_sq - alpha * result.alpha_shift - (along * along + down * down) * (1 / spread);
  result.roughness_sq = squares * (1 / area) * weight * weight;
  result.cd_sq = (cd[0] * cd[0] + cd[1] * cd[1] + cd[2] * cd[2]) * (1 / (area * area));
  return result;
}

inline void SetBit(std::uint8_t* bytes, int x, bool value) {
  if (value) bytes[x / kBlock_px] |= static_cast<std::uint8_t>(1 << x % kBlock_px);
}

/// Sets bits in bytes that are 0.
inline void JudgeWindows(const DistortionRowPair& pair, int begin, int end,
                         const DistortionLimits& limits, const std::array<DecisionBytes, 2>& to,
                         int rows) {
  for (int row = 0; row < rows; ++row) {
    const DistortionRow& values = pair.rows[row];
    for (int x = begin; x < end; ++x) {
      const float shift = values.alpha_shift[x], weight = values.alpha_weight[x];
      const float drift = values.inverse_sigma[x] * limits.drift, drift_sq = drift * drift;
      const auto is_dark = [](const DarknessLimits& dark, float alpha_shift, float normalized) {
        return alpha_shift < dark.shift && normalized < dark.normalized;
      };
      SetBit(to[row].clear_pixels, x,
             is_dark(limits.pixel.dark, shift, shift * weight) ||
                 values.cd_sq[x] > limits.pixel.cd_sq + drift_sq);
      for (std::size_t k = 0; k < kWindows; ++k) {
        const WindowLimits& limit = limits.windows[k];
        const WindowDistortion window = MeasureWindow(pair, row, x, k);
        const float normalized = window.alpha_shift * weight, bright = std::max(normalized, 0.0f);
        const float excess_sq = std::max({(window.cd_sq - drift_sq) * limit.per_cd,
                                          (bright * bright - 3 * drift_sq) * limit.per_alpha,
                                          window.roughness_sq * limit.per_roughness});
        const bool darkens = is_dark(limit.dark, window.alpha_shift, normalized);
        SetBit(to[row].doubtful[k], x, darkens || excess_sq > 1);
        SetBit(to[row].clear[k], x, darkens || excess_sq > limit.margin_sq);
        if (k == 0) SetBit(to[row].dark, x, normalized < limit.dark.normalized);
      }
    }
  }
}

}  // namespace mocap::kernels::reference
