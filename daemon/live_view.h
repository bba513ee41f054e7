// What a person at the terminal sees of the running system.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "daemon/pose_sink.h"
#include "daemon/status_window.h"
#include "daemon/truth_error.h"

namespace mocap {

/// Keeps the latest figures of the last thread for the line on the terminal. OnSet: the pipeline's
/// thread; Line: any.
class LiveView : public PoseSink {
 public:
  /// @param error  may be empty.
  explicit LiveView(TruthError error) : error_(std::move(error)) {}

  void OnSet(const TrackedSet& set) override;
  /// One line without its end: state, rate, latency, residual, voxels, error.
  std::string Line(const StatusReport& report) const;

 private:
  static constexpr double kUnknown = -1;

  const TruthError error_;
  std::atomic<CaptureState> state_{CaptureState::kSearching};
  std::atomic<double> residual_mm_{0};
  std::atomic<double> error_mm_{kUnknown};
  std::atomic<int> voxels_{0};
};

}  // namespace mocap
