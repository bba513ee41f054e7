// Settings of a V4L2 camera. Unset ones stay as they are unless stated otherwise.
#pragma once

#include <optional>
#include <string>

namespace mocap {

struct V4l2Settings {
  std::string format{};  ///< FourCC, such as "YUYV" or "MJPG"; empty: the best that keeps the rate.
  /// If set, these disable the camera's automatic control.
  std::optional<double> exposure_us{};
  std::optional<double> white_balance_k{};
  std::optional<double> gain{};        ///< [the camera's units].
  std::optional<double> focus{};       ///< [the camera's units].
  std::optional<int> power_line_hz{};  ///< 50 or 60; 0: none.
};

}  // namespace mocap
