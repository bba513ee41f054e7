#include "tools/witness/witness_pace.h"

#include <algorithm>

namespace mocap {
namespace {

/// Weight of the latest look in the mean.
constexpr double kLatestWeight = 0.2;
/// Part of the share that is asked for: pictures that come as fast as looks may begin would wait.
constexpr double kAskedPart = 0.9;
/// What a request may ask for.
constexpr double kLeastPicturesHz = 0.2, kMostPicturesHz = 30;

}  // namespace

void WitnessPace::Note(std::int64_t begin_ns, std::int64_t cpu_ns) {
  const auto cost_ns = static_cast<double>(cpu_ns);
  look_ns_ = look_ns_ == 0 ? cost_ns : look_ns_ + kLatestWeight * (cost_ns - look_ns_);
  next_ns_ = begin_ns + static_cast<std::int64_t>(cost_ns / share_);
}

double WitnessPace::Rate(int people, bool is_in_doubt) const {
  const double wanted_hz = is_in_doubt ? 2 * rate_hz_ : rate_hz_;
  const double picture_s = look_ns_ * 1e-9 * std::max(1, people);
  const double affordable_hz = kAskedPart * share_ / std::max(1e-9, picture_s);
  return std::clamp(std::min(wanted_hz, affordable_hz), kLeastPicturesHz, kMostPicturesHz);
}

}  // namespace mocap
