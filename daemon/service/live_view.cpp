#include "daemon/service/live_view.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "drivers/printable_text.h"

namespace mocap {

void LiveView::OnSet(const TrackedSet& set) {
  const bool is_tracking = set.result.state == CaptureState::kTracking;
  state_.store(set.result.state, std::memory_order_relaxed);
  residual_mm_.store(is_tracking ? set.result.residual_mm : kUnknown, std::memory_order_relaxed);
  voxels_.store(set.result.voxels, std::memory_order_relaxed);
  error_mm_.store(error_ && is_tracking ? error_(set) : kUnknown, std::memory_order_relaxed);
  sizes_are_new_ |= set.result.body_changed || is_tracking != was_tracking_;
  was_tracking_ = is_tracking;
  if (!sizes_are_new_) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  sizes_are_new_ = false;
  sizes_ = is_tracking ? std::optional(set.body.sizes()) : std::nullopt;
}

std::optional<BodySizes> LiveView::sizes() const {
  const std::scoped_lock lock(mutex_);
  return sizes_;
}

Fit LiveView::fit() const {
  return {std::max(0.0, residual_mm_.load(std::memory_order_relaxed)),
          voxels_.load(std::memory_order_relaxed)};
}

std::string LiveView::Line(const StatusReport& report) const {
  const auto millimetres = [](double value) {
    return value == kUnknown ? std::string("-") : fmt::format("{:.0f} mm", value);
  };
  const CaptureState state = state_.load(std::memory_order_relaxed);
  std::string line =
      fmt::format("{:<9}  {:4.1f} sets/s  latency {:3.0f} ms  residual {}  {}",
                  kCaptureStateNames[static_cast<std::size_t>(state)], report.sets_per_second,
                  report.recent[Stage::kLatency].PercentileMs(0.5),
                  millimetres(residual_mm_.load(std::memory_order_relaxed)),
                  Counted(voxels_.load(std::memory_order_relaxed), "voxel"));
  if (error_) {
    line += "  error " + millimetres(error_mm_.load(std::memory_order_relaxed));
  }
  return line;
}

}  // namespace mocap
