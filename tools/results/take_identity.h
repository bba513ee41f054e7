// Which take a result is of.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "tools/results/result.h"

namespace mocap {

/// Reads the mark that results of a take get: its name, and the FNV-1a of calibration.toml's bytes.
/// @throws SetupError  as ReadTakeHeader.
TakeMark MarkOf(const std::filesystem::path& take);

/// A take, for comparison with results.
class TakeIdentity {
 public:
  /// @throws SetupError  when it is no take, or its tables are damaged.
  explicit TakeIdentity(const std::filesystem::path& take);

  /// Checks that a result is of this take: by its mark, if it has one, and by its times. Adds
  /// remarks where it may not be, as with another calibration. A log may have been made at another
  /// time.
  /// @throws SetupError  when the result is of another take.
  void Require(const std::filesystem::path& folder_or_log, Result& result) const;

 private:
  /// Capture times of the frames of all cameras.
  struct Times {
    std::int64_t first_ns, last_ns;
    std::int64_t shortest_ns, longest_ns;  ///< Usual intervals of the cameras.
  };
  void CompareTimes(const std::filesystem::path& folder_or_log, Result& result) const;

  std::filesystem::path take_;
  TakeMark mark_;
  std::optional<Times> times_;  ///< Without tables nothing is known.
};

}  // namespace mocap
