#include "tools/view/refusals.h"

namespace mocap {

std::string Refusals::Line(std::int64_t now_ns) {
  if (counts_.empty() || now_ns < next_ns_) return {};
  next_ns_ = now_ns + kPeriodNs;
  std::string line = "refused";
  const char* separator = " ";
  for (const auto& [reason, count] : counts_) {
    line += separator + std::to_string(count) + " × " + reason;
    separator = ", ";
  }
  counts_.clear();
  return line;
}

}  // namespace mocap
