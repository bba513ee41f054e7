#include "daemon/messages/look_wants.h"

#include <algorithm>
#include <cmath>
#include <mocap/look_t.hpp>

namespace mocap {
namespace {

constexpr int kSmallestLook_px = 32;
constexpr std::size_t kLongestAsker = 100;

}  // namespace

void LookWants::Take(const look_request_t& request, std::int64_t now_ns) {
  const std::string name = request.asker.substr(0, kLongestAsker);
  std::erase_if(askers_,
                [&](const Asker& asker) { return asker.name == name || asker.until_ns <= now_ns; });
  // Written so that NaN is none.
  const bool is_wanted = request.rate_hz > 0 && request.hold_s > 0 && request.person >= 0;
  if (!is_wanted || askers_.size() >= kMostAskers) return;
  Asker& asker = askers_.emplace_back();
  asker.name = name;
  asker.want = {.rate_hz = std::clamp(request.rate_hz, kLeastHz, kMostHz),
                .person = request.person,
                .side_px = request.side_px > 0 ? std::max(request.side_px, kSmallestLook_px) : 0,
                .is_raw = request.encoding == look_t::BGR};
  asker.until_ns = now_ns + std::llround(1e9 * std::min(request.hold_s, kLongestHold_s));
}

std::optional<LookWant> LookWants::At(std::int64_t now_ns) {
  std::erase_if(askers_, [&](const Asker& asker) { return asker.until_ns <= now_ns; });
  if (askers_.empty()) return {};
  LookWant all = askers_.front().want;
  for (const Asker& asker : askers_) {
    const LookWant& want = asker.want;
    all.rate_hz = std::max(all.rate_hz, want.rate_hz);
    if (want.person != all.person) all.person = 0;
    all.side_px = want.side_px == 0 || all.side_px == 0 ? 0 : std::max(all.side_px, want.side_px);
    all.is_raw = all.is_raw && want.is_raw;
  }
  return all;
}

}  // namespace mocap
