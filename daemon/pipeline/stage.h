// The stages whose latency the pipeline measures.
#pragma once

#include <array>
#include <string_view>

#include "daemon/pipeline/latency_recorder.h"

namespace mocap {

enum class Stage {
  kSegment,  ///< One camera's frame.
  kCarve,    ///< One set.
  kLabel,    ///< From voxels to measurements.
  kFilter,   ///< From measurements to a pose.
  kPublish,  ///< Handing the pose on.
  kTotal,    ///< A set's work until there is a pose: slowest segmentation, carving, tracking.
  kLatency,  ///< From capture to the pose having been handed on; from the set's last arrival if a
             ///< recording is read at full speed.
  kSpread    ///< Range of the capture times in a set.
};
inline constexpr int kStageCount = 8;
inline constexpr std::array<std::string_view, kStageCount> kStageNames = {
    "segment", "carve", "label", "filter", "publish", "total", "latency", "spread"};

/// The origin of latency.
enum class LatencyOrigin {
  kCapture,  ///< The frames' capture times: cameras, and recordings in real time.
  kArrival   ///< The arrival of a set's last frame: recordings that keep their original times.
};

/// One recorder per stage.
class StageRecorders {
 public:
  LatencyRecorder& operator[](Stage stage) { return recorders_[static_cast<std::size_t>(stage)]; }
  const LatencyRecorder& operator[](Stage stage) const {
    return recorders_[static_cast<std::size_t>(stage)];
  }

 private:
  std::array<LatencyRecorder, kStageCount> recorders_;
};

/// Snapshot of all recorders.
class StageHistograms {
 public:
  StageHistograms() = default;
  explicit StageHistograms(const StageRecorders& recorders) {
    for (int i = 0; i < kStageCount; ++i) {
      histograms_[i] = recorders[static_cast<Stage>(i)].Snapshot();
    }
  }
  const LatencyHistogram& operator[](Stage stage) const {
    return histograms_[static_cast<std::size_t>(stage)];
  }
  StageHistograms Since(const StageHistograms& earlier) const {
    StageHistograms later;
    for (int i = 0; i < kStageCount; ++i) {
      later.histograms_[i] = histograms_[i].Since(earlier.histograms_[i]);
    }
    return later;
  }

 private:
  std::array<LatencyHistogram, kStageCount> histograms_;
};

}  // namespace mocap
