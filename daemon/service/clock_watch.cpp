#include "daemon/service/clock_watch.h"

#include <fmt/format.h>

#include <cstdlib>

namespace mocap {

std::string ClockWatch::Add(std::int64_t ahead_ns) {
  const std::int64_t step_ns = ahead_ns - told_ns_;
  if (std::abs(step_ns) < kLeastNs) return "";
  told_ns_ = ahead_ns;
  return fmt::format(
      "the host's clock was set {} by {:.2f} s; messages carry the new time of day, and tracking "
      "continues",
      step_ns > 0 ? "forward" : "back", static_cast<double>(std::abs(step_ns)) / 1e9);
}

}  // namespace mocap
