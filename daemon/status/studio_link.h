// Whether a node and its studio hear each other.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mocap {

/// A studio reports its status every second, and a camera needs some time until its first frame.
inline constexpr std::int64_t kLongestSilence_ns = 5'000'000'000;

/// What a node knows of its studio.
struct StudioLink {
  std::int64_t silent_ns = 0;  ///< How long no studio has been heard.
  /// Cameras that the studio has not called received for some seconds, although it is heard.
  std::vector<std::string> unreceived = {};
  std::int64_t unrecorded_ns = 0;  ///< How long no studio has said that it records a take.
};

}  // namespace mocap
