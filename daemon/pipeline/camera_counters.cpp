#include "daemon/pipeline/camera_counters.h"

namespace mocap {

void CameraCounters::CountFrame(std::uint64_t sequence) {
  const bool is_first = frames_.fetch_add(1, std::memory_order_relaxed) == 0;
  if (!is_first && sequence > next_sequence_) {
    const auto gap = static_cast<std::int64_t>(sequence - next_sequence_);
    dropped_.fetch_add(gap, std::memory_order_relaxed);
  }
  next_sequence_ = sequence + 1;
}

void CameraCounters::Note(const SegmentedFrame& frame) {
  newest_ns_.store(frame.capture_ns, std::memory_order_relaxed);
  is_blind_.store(frame.is_blind, std::memory_order_relaxed);
  light_.store(frame.light, std::memory_order_relaxed);
  nudged_px_.store(frame.nudged_px, std::memory_order_relaxed);
}

void CameraCounters::CountReplacement() {
  light_.store(1, std::memory_order_relaxed);
  replacements_.fetch_add(1, std::memory_order_relaxed);
}

bool CameraCounters::IsWanted(std::int64_t capture_ns,
                              const std::atomic<std::int64_t>& wanted_from_ns) const {
  const bool starts_anew =
      newest_ns() > kNoneYet && capture_ns < newest_ns() - Synchronizer::kClockStepNs;
  return starts_anew || capture_ns >= wanted_from_ns.load(std::memory_order_relaxed);
}

void CameraCounters::Fill(CameraStatus& status) const {
  status.state = state_.load(std::memory_order_relaxed);
  status.frames = frames_.load(std::memory_order_relaxed);
  status.dropped = dropped_.load(std::memory_order_relaxed);
  status.torn = torn_.load(std::memory_order_relaxed);
  status.replacements = replacements_.load(std::memory_order_relaxed);
  status.light = light_.load(std::memory_order_relaxed);
  status.nudged_px = nudged_px_.load(std::memory_order_relaxed);
  status.is_blind = is_blind_.load(std::memory_order_relaxed);
}

}  // namespace mocap
