// The stages whose latency the pipeline measures.
#pragma once

#include <array>
#include <string_view>

#include "daemon/pipeline/latency_recorder.h"

namespace mocap {

enum class Stage {
  kSegment,  ///< One camera's frame.
  kCarve,    ///< One set.
  kLabel,    ///< From voxels to measured points.
  kFilter,   ///< From points to a pose.
  kPublish,  ///< Handing the pose on.
  kTotal,    ///< A set's work until there is a pose: its slowest segmentation, carving, tracking.
  kLatency,  ///< From capture to the pose having been handed on; from the set's last arrival when a
             ///< recording is read as fast as it can be.
  kSpread    ///< How far the times in a set lie apart.
};
inline constexpr int kStageCount = 8;
inline constexpr std::array<std::string_view, kStageCount> kStageNames = {
    "segment", "carve", "label", "filter", "publish", "total", "latency", "spread"};

/// The origin of latency.
enum class LatencyOrigin {
  kCapture,  ///< The frames' own time: cameras, and recordings in real time.
  kArrival   ///< The arrival of a set's last frame: recordings that keep their old times.
};

/// One recorder a stage.
class StageRecorders {
 public:
  LatencyRecorder& operator[](Stage stage) { return recorders_[static_cast<std::size_t>(stage)]; }
  const LatencyRecorder& operator[](Stage stage) const {
    return recorders_[static_cast<std::size_t>(stage)];
  }

 private:
  std::array<LatencyRecorder, kStageCount> recorders_;
};

/// Their state at one moment.
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
