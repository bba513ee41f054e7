// Reports refused requests without flooding the log.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace mocap {

/// Counts refusals by reason. Reports the first at once, further ones in one line per period.
class Refusals {
 public:
  static constexpr std::int64_t kPeriodNs = 10'000'000'000;

  void Add(const std::string& reason) { ++counts_[reason]; }
  /// Returns a line that is due now, without line end; empty: none.
  std::string Line(std::int64_t now_ns);

 private:
  std::map<std::string, int> counts_;
  std::int64_t next_ns_ = 0;
};

}  // namespace mocap
