#include "daemon/pipeline/people_watch.h"

#include <utility>

#include "core/calibration/diagnosis_text.h"
#include "core/calibration/studio_diagnosis.h"

namespace mocap {
namespace {

/// A person who walks about shows more than one who stands: older moments help to tell.
constexpr std::size_t kMostMoments = 12;
/// What is too small for a person and moves for longer is one, by a calibration of wrong scale.
constexpr std::int64_t kLongest_ns = 30'000'000'000;

}  // namespace

SeenPeople PeopleWatch::Add(std::int64_t capture_ns, SeenMoment moment) {
  // After somebody was away, or a recording began anew, it is another situation.
  const bool goes_on =
      !moments_.empty() && capture_ns > last_ns_ && capture_ns - last_ns_ < kWindow_ns;
  const bool shows_person = ShowsPerson(moment);
  if (!shows_person || !goes_on) moments_.clear();
  if (!shows_person) return {};
  if (moments_.empty()) begin_ns_ = capture_ns;
  last_ns_ = capture_ns;
  if (moments_.size() == kMostMoments) moments_.erase(moments_.begin());
  moments_.push_back(std::move(moment));
  const std::int64_t since_ns = capture_ns - begin_ns_;
  if (since_ns < kWindow_ns || !Moves(cameras_, moments_)) return {};
  const StudioDiagnosis diagnosis = Diagnose(cameras_, moments_);
  // Dogs, and chairs that are pushed about, are no fault.
  if (diagnosis.fault == StudioFault::kStature && since_ns < kLongest_ns) return {};
  return {since_ns, FindingOf(diagnosis, cameras_)};
}

}  // namespace mocap
