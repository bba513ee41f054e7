// Accesses the disk in a thread that nothing waits for.
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

/// What to check and write.
struct DiskErrand {
  std::filesystem::path takes;
  std::filesystem::path background;  ///< Empty: the background has no files.
  std::vector<CutOffTake> cut_off;   ///< As found at the start.
  std::filesystem::path metrics;     ///< Empty: nothing is written.
  std::string metrics_text;
};

/// Results of an errand.
struct DiskFindings {
  std::int64_t bytes_free = 0;        ///< For takes.
  std::filesystem::path takes_place;  ///< The folder for takes, or its nearest existing parent.
  /// Why takes cannot be written, with `takes_place` if that is a parent; empty: they can.
  std::string takes_problem;
  std::int64_t background_made_s = 0;
  std::vector<CutOffTake> cut_off;  ///< Those that still exist.
  bool could_write_metrics = true;
};

DiskFindings RunErrand(const DiskErrand& errand);

/// Runs errands in its own thread: a stalled disk delays nothing else. Thread-safe.
class DiskWatch {
 public:
  using Run = std::function<DiskFindings(const DiskErrand&)>;

  explicit DiskWatch(Run run = RunErrand);
  /// Does not wait for a stalled disk.
  ~DiskWatch();

  /// Queues an errand; replaces one that was queued but not begun.
  void Send(DiskErrand errand);
  /// Results of the last completed errand; empty before the first.
  std::optional<DiskFindings> Findings() const;
  /// Duration of the running errand so far; 0: none.
  std::int64_t UnderWayNs(std::int64_t now_ns) const;
  /// Waits until an errand has completed, but for no longer than `most_ns`.
  void WaitForFindings(std::int64_t most_ns) const;

 private:
  struct Shared;
  static void Work(const std::shared_ptr<Shared>& shared, const Run& run);

  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

}  // namespace mocap
