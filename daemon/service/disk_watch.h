// Asks the disk in a thread that nothing waits for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "daemon/recording/cut_off_takes.h"

namespace mocap {

/// What shall be looked at and written.
struct DiskErrand {
  std::filesystem::path takes;
  std::filesystem::path background;  ///< Empty: it has no files of its own.
  std::vector<CutOffTake> cut_off;   ///< As far as they were there.
  std::filesystem::path metrics;     ///< Empty: nothing is written.
  std::string metrics_text;
};

/// Findings.
struct DiskFindings {
  std::int64_t bytes_free = 0;  ///< For takes.
  std::string takes_problem;    ///< Why none can be written; empty: they can.
  std::int64_t background_made_s = 0;
  std::vector<CutOffTake> cut_off;  ///< Those that still are there.
  bool could_write_metrics = true;
};

DiskFindings RunErrand(const DiskErrand& errand);

/// Runs errands in a thread of its own: a disk that stalls holds up nothing but these.
/// Thread-safe.
class DiskWatch {
 public:
  using Run = std::function<DiskFindings(const DiskErrand&)>;

  explicit DiskWatch(Run run = RunErrand);
  /// Waits for nothing that stalls.
  ~DiskWatch();

  /// Wants this done next; replaces what was wanted and not begun.
  void Send(DiskErrand errand);
  /// What the last errand that came to its end found; empty before the first.
  std::optional<DiskFindings> Findings() const;
  /// How long the errand that is under way has been; 0: none is.
  std::int64_t UnderWayNs(std::int64_t now_ns) const;
  /// Waits until an errand has come to its end, but no longer than that.
  void WaitForFindings(std::int64_t most_ns) const;

 private:
  struct Shared;
  static void Work(const std::shared_ptr<Shared>& shared, const Run& run);

  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

}  // namespace mocap
