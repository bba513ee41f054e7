// Detects sudden changes of the light in the studio.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "daemon/pipeline/frame_path.h"

namespace mocap {

/// A sudden change of light.
struct LightChange {
  std::int64_t time_ns = 0;          ///< When it was noticed, by the clock of Add.
  std::vector<std::string> cameras;  ///< Those that saw it.
  double factor = 1;                 ///< The increase of brightness in the first of them.
};

/// Compares each camera's light with that of some seconds ago: lamps that are switched, the sun
/// that comes out. The cameras' threads compensate slow changes, which are not reported.
class LightWatch {
 public:
  /// Minimum change of brightness, up or down.
  static constexpr double kSuddenFactor = 1.15;

  /// Adds the present status; call every second.
  /// @return  the latest change, while it is recent.
  std::optional<LightChange> Add(const PipelineStatus& status, std::int64_t now_ns);

 private:
  struct Seen {
    double light = 0;      ///< 0: the camera does not stream.
    int replacements = 0;  ///< Identifies the background that the light is relative to.
  };
  static std::vector<Seen> SeenIn(const PipelineStatus& status);

  std::deque<std::vector<Seen>> past_;
  std::optional<LightChange> change_;
};

}  // namespace mocap
