#include "daemon/pipeline/people_watch.h"

#include <utility>

#include "core/calibration/diagnosis_text.h"
#include "core/calibration/studio_diagnosis.h"

namespace mocap {
namespace {

/// A person who walks about shows more than one who stands: older moments help to tell.
constexpr std::size_t kMostMoments = 12;

}  // namespace

SeenPeople PeopleWatch::Add(std::int64_t capture_ns, SeenMoment moment) {
  // After somebody was away, or a recording began anew, it is another situation.
  const bool goes_on = !times_ns_.empty() && capture_ns > times_ns_.back() &&
                       capture_ns - times_ns_.back() < kWindow_ns;
  if (!ShowsPerson(moment) || !goes_on) {
    times_ns_.clear();
    moments_.clear();
  }
  if (!ShowsPerson(moment)) return {};
  times_ns_.push_back(capture_ns);
  moments_.push_back(std::move(moment));
  if (moments_.size() > kMostMoments) {
    times_ns_.pop_front();
    moments_.erase(moments_.begin());
  }
  if (capture_ns - times_ns_.front() < kWindow_ns || !Moves(moments_)) return {};
  const StudioDiagnosis diagnosis = Diagnose(cameras_, moments_);
  // A dog, or a chair that is pushed about.
  if (diagnosis.fault == StudioFault::kStature) return {};
  return {true, FindingOf(diagnosis, cameras_)};
}

}  // namespace mocap
