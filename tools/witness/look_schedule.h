// Which picture of whom a witness looks at next.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>

namespace mocap {

/// Looks at each person at a steady rate, through one camera after the other. Thread-bound.
class LookSchedule {
 public:
  /// @param rate_hz  looks at each person, per second of capture time.
  LookSchedule(int cameras, double rate_hz);

  /// Returns the camera to look through at a person at this time: of those that see the person, the
  /// one after the last.
  /// @param sees  asked for cameras in turn. @return  empty: not yet, or no camera does.
  std::optional<int> Next(int person, std::int64_t capture_ns,
                          const std::function<bool(int camera)>& sees);

 private:
  struct Turn {
    std::int64_t due_ns;
    int camera;  ///< The next to ask.
  };

  const int cameras_;
  const std::int64_t period_ns_;
  std::map<int, Turn> turns_;  ///< By person.
};

}  // namespace mocap
