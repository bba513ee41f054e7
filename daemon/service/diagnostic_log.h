// What the log tells of complaints: that one begins, and that all of them have ended.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mocap {

/// Logs a complaint that lasts, once; what comes and goes is told once a quarter of an hour.
class DiagnosticLog {
 public:
  /// Takes the complaints of this moment; wanted every second. @return what it logged.
  std::vector<std::string> Add(const std::vector<std::string>& complaints, std::int64_t now_ns);

 private:
  struct Known {
    std::int64_t first_ns = 0;  ///< Of this time.
    std::int64_t last_ns = 0;
    std::int64_t told_ns = kNever;
  };
  static constexpr std::int64_t kNever = -1;

  std::map<std::string, Known> known_;  ///< By its words without its numbers.
  bool has_told_ = false;
};

}  // namespace mocap
