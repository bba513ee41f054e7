// Results of trackers of the same sets that begin with different ones.
#pragma once

#include <deque>
#include <vector>

#include "daemon/pipeline/frame_path.h"
#include "tools/results/result_sink.h"

namespace mocap {

/// One result per tracker, the k-th of which begins with set k. Outlives the pipeline.
class FirstSinks {
 public:
  /// @param count  at least one.
  FirstSinks(int count, KeptPeople kept) {
    for (int first = 0; first < count; ++first) sinks_.emplace_back(kept, false);
  }

  /// Of the pipeline's own tracker.
  PoseSink& own() { return sinks_.front(); }
  /// For PipelineOptions.
  std::vector<PipelineOptions::OtherStart> others() {
    std::vector<PipelineOptions::OtherStart> others;
    for (std::size_t first = 1; first < sinks_.size(); ++first)
      others.push_back({static_cast<std::int64_t>(first), &sinks_[first]});
    return others;
  }
  const std::deque<ResultSink>& all() const { return sinks_; }

 private:
  std::deque<ResultSink> sinks_;  // A deque: sinks cannot move.
};

}  // namespace mocap
