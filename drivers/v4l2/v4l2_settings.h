// What can be set of a V4L2 camera. What is not set stays as it is, unless it is said otherwise.
#pragma once

#include <optional>
#include <string>

namespace mocap {

struct V4l2Settings {
  std::string format{};  ///< Its fourcc, as "YUYV" or "MJPG"; empty: the best that keeps the rate.
  /// Given, these switch the camera's automatic off.
  std::optional<double> exposure_us{};
  std::optional<double> white_balance_k{};
  std::optional<double> gain{};        ///< [the camera's units].
  std::optional<double> focus{};       ///< [the camera's units].
  std::optional<int> power_line_hz{};  ///< 50 or 60; 0: none.
};

}  // namespace mocap
