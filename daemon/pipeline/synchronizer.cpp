#include "daemon/pipeline/synchronizer.h"

#include <algorithm>

#include "core/errors.h"

namespace mocap {

Synchronizer::Synchronizer(int cameras, std::int64_t nominal_period_ns, double patience_periods)
    : cameras_(cameras),
      nominal_period_ns_(nominal_period_ns),
      patience_periods_(patience_periods),
      members_(cameras) {
  times_.reserve(cameras);
}

bool Synchronizer::Offer(int camera, std::int64_t capture_ns, std::uint64_t sequence) {
  Camera& offering = cameras_[camera];
  MOCAP_CHECK(!offering.has_front);
  if (StartsAnew(camera, capture_ns)) StartAnew(offering, capture_ns);
  if (offering.has_last && capture_ns <= offering.last_ns) {
    ++offering.late;
    return false;
  }
  offering.period.Add(capture_ns, sequence);
  offering.has_front = offering.has_last = true;
  offering.given_up = false;
  offering.front_ns = offering.last_ns = capture_ns;
  NoteNewest(capture_ns);
  return true;
}

void Synchronizer::StartAnew(Camera& camera, std::int64_t capture_ns) {
  camera.has_last = false;
  camera.period = {};
  // A single wrong stamp does not discard what the other cameras say.
  if (capture_ns < set_ns_ - kClockStepNs) set_ns_ = kLongAgoNs;
  if (capture_ns < newest_ns_ - kClockStepNs) newest_ns_ = capture_ns;
}

bool Synchronizer::LetGoBefore(int camera, std::int64_t capture_ns) {
  Camera& holder = cameras_[camera];
  if (!holder.has_front || holder.front_ns >= capture_ns) return false;
  holder.has_front = false;
  return true;
}

void Synchronizer::NoteNewest(std::int64_t capture_ns) {
  newest_ns_ = std::max(newest_ns_, capture_ns);
}

void Synchronizer::NoteNewest(int camera, std::int64_t capture_ns) {
  NoteNewest(capture_ns);
  Camera& holder = cameras_[camera];
  if (!holder.has_front || capture_ns >= holder.front_ns - kClockStepNs) return;
  holder.has_front = false;
  ++holder.late;
}

Synchronizer::Decision Synchronizer::Decide() {
  times_.clear();
  int stalest = -1;
  for (int i = 0; i < static_cast<int>(cameras_.size()); ++i) {
    if (!cameras_[i].has_front) continue;
    times_.push_back(cameras_[i].front_ns);
    if (stalest < 0 || cameras_[i].front_ns < cameras_[stalest].front_ns) stalest = i;
  }
  if (times_.empty()) return Decision::kWait;
  std::ranges::sort(times_);
  const std::int64_t reference_ns = times_[(times_.size() - 1) / 2];
  const std::int64_t period_ns = PeriodNs();
  if (MustWait(reference_ns, period_ns)) return Decision::kWait;
  const bool set_has_gone = times_.front() <= set_ns_ + period_ns / 4;
  if (set_has_gone || reference_ns - times_.front() > period_ns / 2) return LetGo(stalest);
  return FormSet(reference_ns, period_ns / 2);
}

std::int64_t Synchronizer::PeriodNs() const {
  // The fastest camera sets the pace. A slower camera still joins some sets.
  std::int64_t shortest_ns = 0;
  for (const Camera& camera : cameras_) {
    const std::int64_t period_ns = camera.period.period_ns();
    if (period_ns > 0 && (shortest_ns == 0 || period_ns < shortest_ns)) shortest_ns = period_ns;
  }
  return shortest_ns > 0 ? shortest_ns : nominal_period_ns_;
}

bool Synchronizer::MustWait(std::int64_t reference_ns, std::int64_t period_ns) const {
  const auto ahead_ns = static_cast<double>(newest_ns_ - reference_ns);
  const bool is_patient = ahead_ns <= patience_periods_ * static_cast<double>(period_ns);
  return std::ranges::any_of(cameras_, [&](const Camera& camera) {
    if (camera.has_front || camera.expectation == Expectation::kNone) return false;
    return camera.expectation == Expectation::kCertain || (is_patient && !camera.given_up);
  });
}

Synchronizer::Decision Synchronizer::LetGo(int camera) {
  cameras_[camera].has_front = false;
  ++cameras_[camera].late;
  let_go_ = camera;
  return Decision::kLetGo;
}

Synchronizer::Decision Synchronizer::FormSet(std::int64_t reference_ns,
                                             std::int64_t half_period_ns) {
  // One camera gives no volume, unless the studio has only one.
  const std::size_t fewest = std::min<std::size_t>(2, cameras_.size());
  const std::int64_t end_ns = reference_ns + half_period_ns;
  const std::size_t count = std::ranges::upper_bound(times_, end_ns) - times_.begin();
  if (count < fewest) {
    const auto alone = std::ranges::find_if(cameras_, [&](const Camera& camera) {
      return camera.has_front && camera.front_ns <= end_ns;
    });
    return LetGo(static_cast<int>(alone - cameras_.begin()));
  }
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (!cameras_[i].has_front) cameras_[i].given_up = true;
    members_[i] = cameras_[i].has_front && cameras_[i].front_ns <= end_ns;
    if (members_[i]) cameras_[i].has_front = false;
  }
  std::int64_t sum_ns = 0;
  for (std::size_t i = 0; i < count; ++i) sum_ns += times_[i] - times_[0];
  set_ns_ = times_[0] + sum_ns / static_cast<std::int64_t>(count);
  spread_ns_ = times_[count - 1] - times_[0];
  return Decision::kSet;
}

}  // namespace mocap
