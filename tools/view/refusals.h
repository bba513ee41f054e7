// What was refused, told without flooding the log.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace mocap {

/// Counts refusals by their reason. The first one is told at once, the rest in one line a period.
class Refusals {
 public:
  static constexpr std::int64_t kPeriodNs = 10'000'000'000;

  void Add(const std::string& reason) { ++counts_[reason]; }
  /// A line that is due now, without its end; empty: none.
  std::string Line(std::int64_t now_ns);

 private:
  std::map<std::string, int> counts_;
  std::int64_t next_ns_ = 0;
};

}  // namespace mocap
