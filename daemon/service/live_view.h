// The running system as a person at the terminal sees it.
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

/// Keeps the latest figures of the last thread for whoever asks. OnSet: the pipeline's thread; the
/// rest: any.
class LiveView : public PoseSink {
 public:
  /// @param error  may be empty.
  explicit LiveView(TruthError error) : error_(std::move(error)) {}

  void OnSet(const TrackedSet& set) override;
  Fit fit() const;
  /// Who is followed, in the order of their numbers.
  std::vector<FollowedPerson> people() const;
  /// One line without its end: state, rate, latency, residual, voxels, error.
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

  mutable std::mutex mutex_;  ///< Tried, never waited for, by the pipeline.
  std::vector<FollowedPerson> people_;
};

}  // namespace mocap
