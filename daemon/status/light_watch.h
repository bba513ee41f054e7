// Whether the light in the studio changed all of a sudden.
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
  std::int64_t time_ns = 0;          ///< As it was noticed, by the clock of Add.
  std::vector<std::string> cameras;  ///< That saw it.
  double factor = 1;                 ///< By which the first of them got brighter.
};

/// Compares each camera's light with that of some seconds ago: lamps that are switched, the sun
/// that comes out. What changes slowly is followed by the cameras' threads and not told.
class LightWatch {
 public:
  /// How much brighter or darker it has to get.
  static constexpr double kSuddenFactor = 1.15;

  /// Adds the status of this moment; wanted every second.
  /// @return  the latest change, while it is news.
  std::optional<LightChange> Add(const PipelineStatus& status, std::int64_t now_ns);

 private:
  struct Seen {
    double light = 0;      ///< 0: the camera does not stream.
    int replacements = 0;  ///< What the light is compared with.
  };
  static std::vector<Seen> SeenIn(const PipelineStatus& status);

  std::deque<std::vector<Seen>> past_;
  std::optional<LightChange> change_;
};

}  // namespace mocap
