#include "tools/witness/look_planner.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <utility>

#include "drivers/take/take_layout.h"
#include "tools/stop_on_signals.h"

namespace mocap {
namespace {

/// A camera that shows less of a person does not see the person.
constexpr double kLeastInPicture = 0.5;
/// The first person's number, who is not yet among the people while being measured.
constexpr int kMeasuredPerson = 1;

/// The picture that was taken nearest to a time.
/// @pre  the table has rows.
const TakeRow& NearestRow(const TakeTable& table, std::int64_t time_ns) {
  const auto after = std::ranges::lower_bound(table.rows, time_ns, {}, &TakeRow::timestamp_ns);
  if (after == table.rows.end()) return table.rows.back();
  if (after == table.rows.begin()) return *after;
  const auto before = std::prev(after);
  return time_ns - before->timestamp_ns <= after->timestamp_ns - time_ns ? *before : *after;
}

}  // namespace

std::vector<TimedCamera> TimedCamerasOf(const std::filesystem::path& take,
                                        const std::vector<CameraCalibration>& calibrations) {
  std::vector<TimedCamera> cameras;
  for (const CameraCalibration& calibration : calibrations)
    cameras.push_back({calibration, ReadTakeTable(TakeLayout{take}.Table(calibration.name))});
  return cameras;
}

LookPlanner::LookPlanner(std::vector<TimedCamera> cameras, double fps, double rate_hz)
    : cameras_(std::move(cameras)),
      tolerance_ns_(std::llround(0.75e9 / fps)),
      schedule_(static_cast<int>(cameras_.size()), rate_hz) {}

void LookPlanner::OnSet(const TrackedSet& set) {
  EndIfStopAsked();
  for (const PersonView& person : set.people)
    Plan(set, person.id, person.capture->result(), person.capture->body());
  if (set.people.empty()) Plan(set, kMeasuredPerson, set.result, set.body);
}

void LookPlanner::Plan(const TrackedSet& set, int person, const CaptureResult& captured,
                       const BodyModel& body) {
  if (captured.state == CaptureState::kSearching) return;
  posed_.Set(body, captured.pose);
  Look look;
  const auto sees = [&](int camera) {
    if ((set.cameras >> camera & 1) == 0) return false;
    const auto& [calibration, table] = cameras_[camera];
    const TakeRow& row = NearestRow(table, set.capture_ns);
    if (std::abs(row.timestamp_ns - set.capture_ns) > tolerance_ns_) return false;
    const auto seen = SeeBody(posed_.capsules(), calibration, calibration.PoseAt(row.angles));
    if (!seen || seen->in_picture < kLeastInPicture) return false;
    look = {camera, row.timestamp_ns, person, seen->box};
    return true;
  };
  if (schedule_.Next(person, set.capture_ns, sees)) looks_.push_back(look);
}

}  // namespace mocap
