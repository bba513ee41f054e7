#include "daemon/pipeline/load_control.h"

#include <algorithm>

namespace mocap {

void LoadControl::AddSet(std::int64_t capture_ns, std::int64_t arrival_ns, std::int64_t now_ns,
                         std::int64_t period_ns) {
  const bool follows_a_gap =
      has_last_ && last_ns_ < wanted_from_ns_ && wanted_from_ns_ <= capture_ns;
  if (follows_a_gap) skipped_ += (capture_ns - last_ns_ - period_ns / 2) / period_ns;
  has_last_ = true;
  last_ns_ = capture_ns;
  captures_ns_[sets_++ % kMostUnderWay] = capture_ns;
  period_ns_ = period_ns;
  NoteDelay(arrival_ns - capture_ns, now_ns);
  const std::int64_t age_ns = now_ns - capture_ns - least_delay_ns_;
  if (age_ns <= ToleranceNs(now_ns)) return;
  LosePatience(now_ns);
  WantNext(now_ns);
}

void LoadControl::StartAnew() {
  wanted_from_ns_ = kAll;
  has_last_ = false;
  impatient_until_ns_ = kAll;
  least_delay_ns_ = least_of_span_ns_ = kNoDelayYet;
  span_begin_ns_ = kNever;
}

void LoadControl::NoteDelay(std::int64_t delay_ns, std::int64_t now_ns) {
  const bool has_span = span_begin_ns_ <= now_ns && now_ns - span_begin_ns_ < kDelaySpanNs;
  if (!has_span) {
    // Without an earlier span, only this delay is known.
    least_delay_ns_ = least_of_span_ns_;
    least_of_span_ns_ = kNoDelayYet;
    span_begin_ns_ = now_ns;
  }
  least_of_span_ns_ = std::min(least_of_span_ns_, delay_ns);
  least_delay_ns_ = std::min(least_delay_ns_, least_of_span_ns_);
}

void LoadControl::SetUnderWay(std::int64_t sets, std::int64_t now_ns) {
  if (IsFull(sets, now_ns)) {
    LosePatience(now_ns);
    wanted_from_ns_ = kNever;
  } else if (wanted_from_ns_ == kNever) {
    WantNext(now_ns);
  }
}

std::int64_t LoadControl::ToleranceNs(std::int64_t now_ns) const {
  const std::int64_t usual_ns = kTolerancePeriods * period_ns_;
  return now_ns < impatient_until_ns_ ? usual_ns : std::max(usual_ns, kPatienceNs);
}

void LoadControl::LosePatience(std::int64_t now_ns) { impatient_until_ns_ = now_ns + kLatelyNs; }

bool LoadControl::IsFull(std::int64_t sets, std::int64_t now_ns) const {
  if (sets < 2) return false;
  if (sets >= kMostUnderWay) return true;
  if (!has_last_) return false;
  const std::int64_t oldest_ns = captures_ns_[(sets_ - std::min(sets, sets_)) % kMostUnderWay];
  return now_ns - least_delay_ns_ - oldest_ns > ToleranceNs(now_ns);
}

void LoadControl::WantNext(std::int64_t now_ns) {
  if (!has_last_) {
    wanted_from_ns_ = kAll;
    return;
  }
  const std::int64_t since_last_ns = std::max<std::int64_t>(0, now_ns - least_delay_ns_ - last_ns_);
  wanted_from_ns_ = last_ns_ + since_last_ns / period_ns_ * period_ns_ + period_ns_ / 2;
}

}  // namespace mocap
