// The state of the running system, for people at a terminal.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "daemon/messages/truth_error.h"
#include "daemon/pipeline/pose_sink.h"
#include "daemon/status/followed_person.h"
#include "daemon/status/service_report.h"
#include "daemon/status/status_window.h"

namespace mocap {

/// Keeps the latest results of the tracking thread for other threads. OnSet: the pipeline's thread;
/// the rest: any.
class LiveView : public PoseSink {
 public:
  /// @param error  may be empty.
  explicit LiveView(TruthError error) : error_(std::move(error)) {}

  void OnSet(const TrackedSet& set) override;
  Fit fit() const;
  /// The tracked people, sorted by number.
  std::vector<FollowedPerson> people() const;
  /// One line without newline: state, rate, latency, residual, voxels, error.
  std::string Line(const StatusReport& report) const;

 private:
  void TakePeople(std::span<const PersonView> people);

  static constexpr double kUnknown = -1;

  const TruthError error_;
  std::atomic<CaptureState> state_{CaptureState::kSearching};
  std::atomic<double> residual_mm_{0};
  std::atomic<double> error_mm_{kUnknown};
  std::atomic<int> voxels_{0};
  std::atomic<int> count_{0};

  mutable std::mutex mutex_;  ///< The pipeline tries it, but never waits.
  std::vector<FollowedPerson> people_;
};

}  // namespace mocap
