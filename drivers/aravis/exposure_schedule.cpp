#include "drivers/aravis/exposure_schedule.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/errors.h"

namespace mocap {
namespace {

/// If two readings of an offset differ by more, a clock was set.
constexpr std::int64_t kWasSet_ns = 500'000'000;

}  // namespace

ExposureSchedule::ExposureSchedule(double fps) : period_ns_(std::llround(1e9 / fps)) {}

void ExposureSchedule::SetOffset(std::int64_t offset_ns) {
  if (!offset_ns_ || std::abs(offset_ns - *offset_ns_) > kWasSet_ns) last_ns_ = 0;
  offset_ns_ = offset_ns;
}

std::int64_t ExposureSchedule::Next(std::int64_t now_ns) {
  MOCAP_CHECK(offset_ns_);
  const std::int64_t earliest_ns = now_ns + *offset_ns_ + kLeastAhead_ns;
  const std::int64_t in_time_ns = (earliest_ns + period_ns_ - 1) / period_ns_ * period_ns_;
  last_ns_ = std::max(in_time_ns, last_ns_ + period_ns_);
  return last_ns_;
}

}  // namespace mocap
