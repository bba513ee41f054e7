#include "core/acquisition/facing_duel.h"

#include <algorithm>
#include <cmath>

#include "core/counted_time.h"

namespace mocap {
namespace {

// A body is right if it costs this much less for this long. More in one frame counts no more.
constexpr double kMostLeadMm = 3;
constexpr double kClearLeadMm_s = 0.3;
constexpr int kLeastFrames = 3;
constexpr double kLongestS = 2;

}  // namespace

void FacingDuel::Add(double lead_mm, double dt_s) {
  ++frames_;
  const double counted_s = CountedS(dt_s);
  lead_mm_s_ += std::clamp(lead_mm, -kMostLeadMm, kMostLeadMm) * counted_s;
  age_s_ += counted_s;
}

bool FacingDuel::is_over() const {
  const bool is_clear = frames_ >= kLeastFrames && std::abs(lead_mm_s_) > kClearLeadMm_s;
  return is_clear || age_s_ > kLongestS;
}

}  // namespace mocap
