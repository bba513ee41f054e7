#include "daemon/service/diagnostic_log.h"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace mocap {
namespace {

/// Shorter diagnostics appear in the status, but not in the log.
constexpr std::int64_t kLastingNs = 2'000'000'000;
/// A diagnostic that was absent for this long counts as new.
constexpr std::int64_t kGoneNs = 10'000'000'000;
constexpr std::int64_t kToldAgainNs = 900'000'000'000;

std::string WithoutNumbers(std::string text) {
  std::erase_if(text, [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
  return text;
}

}  // namespace

std::vector<std::string> DiagnosticLog::Add(const std::vector<std::string>& complaints,
                                            std::int64_t now_ns) {
  std::vector<std::string> told;
  for (const std::string& complaint : complaints) {
    Known& known = known_.try_emplace(WithoutNumbers(complaint)).first->second;
    const bool begins = known.last_ns == 0 || now_ns - known.last_ns > kGoneNs;
    if (begins) known.first_ns = now_ns;
    known.last_ns = now_ns;
    const bool is_old = known.told_ns != kNever && known.told_ns >= known.first_ns;
    const bool was_told_lately = known.told_ns != kNever && now_ns - known.told_ns < kToldAgainNs;
    if (is_old || was_told_lately || now_ns - known.first_ns < kLastingNs) continue;
    known.told_ns = now_ns;
    told.push_back(complaint);
  }
  for (const std::string& complaint : told) spdlog::warn("{}", complaint);
  std::erase_if(known_, [&](const auto& entry) {
    const auto& [text, known] = entry;
    const bool was_told_lately = known.told_ns != kNever && now_ns - known.told_ns < kToldAgainNs;
    return now_ns - known.last_ns > kGoneNs && !was_told_lately;
  });
  has_told_ |= !told.empty();
  const bool all_gone = std::ranges::all_of(
      known_, [&](const auto& entry) { return now_ns - entry.second.last_ns > kGoneNs; });
  if (has_told_ && all_gone) {
    has_told_ = false;
    told.emplace_back("all is good again");
    spdlog::info("{}", told.back());
  }
  return told;
}

}  // namespace mocap
