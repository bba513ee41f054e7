// The status of programs that send keypoints.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mocap {

/// Why a message with keypoints is refused.
enum class KeypointRefusal {
  kInvalid,  ///< It is no such message, or of another version.
  kCamera,   ///< It is of another studio's camera.
  kOld,      ///< The tracker no longer knows that moment.
  kAhead,    ///< The moment has not come yet.
  kEmpty,    ///< It has no point that can be used.
  kFull      ///< Too many were waiting.
};
inline constexpr std::size_t kKeypointRefusalCount = 6;
inline constexpr std::array<std::string_view, kKeypointRefusalCount> kKeypointRefusalNames = {
    "invalid", "camera", "old", "ahead", "empty", "full"};

/// A program that sends keypoints.
struct KeypointSender {
  std::string name;
  double views_per_second = 0;  ///< Lately: people in pictures.
  double lag_ms = 0;            ///< From capture to arrival, median.
  std::int64_t taken = 0;
  std::array<std::int64_t, kKeypointRefusalCount> refused{};  ///< By KeypointRefusal.
  std::int64_t dropped_points = 0;  ///< Of those taken: without a place, a number or a pixel.
  std::optional<double> agreement;  ///< With the poses, 0 to 1, median; empty: not known.

  std::int64_t RefusedInAll() const {
    std::int64_t sum = 0;
    for (const std::int64_t count : refused) sum += count;
    return sum;
  }
};

/// Everybody who sends keypoints.
struct KeypointsReport {
  std::vector<KeypointSender> senders;  ///< Heard lately, by name.
  std::int64_t strangers = 0;           ///< Messages whose sender is not known or one too many.
};

}  // namespace mocap
