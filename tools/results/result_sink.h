// The end of a pipeline whose poses are to be kept.
#pragma once

#include <cstddef>

#include "daemon/pipeline/pose_sink.h"
#include "tools/results/result.h"

namespace mocap {

/// Keeps every set as a row of a result.
class ResultSink : public PoseSink {
 public:
  /// @param shows_progress  on a terminal: how far it is, on stderr.
  explicit ResultSink(bool shows_progress) : shows_progress_(shows_progress) {}

  void OnSet(const TrackedSet& set) override;
  /// Clears the line that showed the progress.
  void EndProgress() const;

  const Result& result() const { return result_; }
  std::size_t frames() const { return result_.poses.size(); }
  std::size_t tracked_frames() const { return tracked_frames_; }
  int acquisition_frames() const { return acquisition_frames_; }

 private:
  const bool shows_progress_;
  Result result_;
  std::size_t tracked_frames_ = 0;
  int acquisition_frames_ = 0;
};

}  // namespace mocap
