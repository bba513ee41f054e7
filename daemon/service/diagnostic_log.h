// Logs when a diagnostic begins, and when all have ended.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mocap {

/// Logs a lasting diagnostic once. One that comes and goes is logged every quarter of an hour.
class DiagnosticLog {
 public:
  /// Takes the present diagnostics; call every second. @return what it logged.
  std::vector<std::string> Add(const std::vector<std::string>& complaints, std::int64_t now_ns);

 private:
  struct Known {
    std::int64_t first_ns = 0;  ///< Of the present occurrence.
    std::int64_t last_ns = 0;
    std::int64_t told_ns = kNever;
  };
  static constexpr std::int64_t kNever = -1;

  std::map<std::string, Known> known_;  ///< Keys are the texts without their numbers.
  bool has_told_ = false;
};

}  // namespace mocap
