// Whether a node and its studio hear each other.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mocap {

/// What a node knows of its studio.
struct StudioLink {
  std::int64_t silent_ns = 0;  ///< How long no studio has been heard.
  /// Cameras that the studio has not called received for some seconds, although it is heard.
  std::vector<std::string> unreceived = {};
};

}  // namespace mocap
