#include "tools/kinematics/gait_events.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tools/results/export_axes.h"

namespace mocap {
namespace {

constexpr double kHalfWindow_s = 0.25;
// Frames farther apart than this many periods leave a gap: one lost frame leaves none.
constexpr double kGapPeriods = 2.5;
constexpr double kLeastPhase_s = 0.08;
// A foot that goes forward and back by less relative to the pelvis takes no step [mm]: it swings by
// the length of a step, and hips that sway move it by some 50 mm.
constexpr double kLeastSwing_mm = 100;

double MedianPeriod_s(const std::vector<PoseRow>& rows) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < rows.size(); ++i)
    periods.push_back(static_cast<double>(rows[i].timestamp_ns - rows[i - 1].timestamp_ns) * 1e-9);
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::ranges::nth_element(periods, middle);
  return *middle;
}

Vector3 FurtherOf(const PoseRow& row, Point point) { return FurtherOf(row.further_W, point); }

bool HasContacts(const PoseRow& row) { return IsTracked(row) && row.contacts.allFinite(); }

GaitFrame FrameOf(const PoseRow& row, std::int64_t start_ns) {
  const auto at = [&](Point point) -> Vector3 { return row.points_W.col(static_cast<int>(point)); };
  GaitFrame frame;
  frame.time_s = static_cast<double>(row.timestamp_ns - start_ns) * 1e-9;
  frame.pelvis_W = (at(Point::kHipL) + at(Point::kHipR)) / 2;
  frame.heel_W = {FurtherOf(row, Point::kHeelL), FurtherOf(row, Point::kHeelR)};
  frame.toe_W = {FurtherOf(row, Point::kToeL), FurtherOf(row, Point::kToeR)};
  for (const int side : {0, 1})
    frame.contact[side] = std::max(row.contacts[side], row.contacts[2 + side]);
  return frame;
}

// An extremum of a signal: the vertex of the parabola through three samples.
double VertexTime(std::span<const GaitFrame> run, std::span<const double> signal, std::size_t i) {
  const double before = signal[i - 1] - signal[i], after = signal[i + 1] - signal[i];
  const double curvature = before + after;
  const double offset =
      curvature == 0 ? 0 : std::clamp((before - after) / (2 * curvature), -0.5, 0.5);
  const double period_s = (run[i + 1].time_s - run[i - 1].time_s) / 2;
  return run[i].time_s + offset * period_s;
}

// Adds the maxima of a signal that rise by kLeastSwing_mm above what is between them. Frames
// without a direction are NaN and end a walk.
void AddMaxima(std::span<const GaitFrame> run, std::span<const double> signal, Side side,
               GaitEventKind kind, std::vector<GaitEvent>& events) {
  std::size_t highest = 0;
  double lowest_mm = std::nan("");  // Since the last maximum; NaN before the first frame of a walk.
  bool rising = false;
  for (std::size_t i = 0; i < signal.size(); ++i) {
    if (std::isnan(signal[i])) {
      lowest_mm = std::nan("");
      rising = false;
      continue;
    }
    if (std::isnan(lowest_mm)) lowest_mm = signal[i];
    if (!rising) {
      lowest_mm = std::min(lowest_mm, signal[i]);
      rising = signal[i] - lowest_mm > kLeastSwing_mm;
      highest = i;
    } else if (signal[i] >= signal[highest]) {
      highest = i;
    } else if (signal[highest] - signal[i] > kLeastSwing_mm) {
      events.push_back({side, kind, VertexTime(run, signal, highest)});
      rising = false;
      lowest_mm = signal[i];
    }
  }
}

// When a foot's contact begins and ends.
std::vector<GaitEvent> CrossingsOf(std::span<const GaitFrame> run, Side side) {
  const auto foot = static_cast<std::size_t>(side);
  std::vector<GaitEvent> events;
  for (std::size_t i = 1; i < run.size(); ++i) {
    const double before = run[i - 1].contact[foot], after = run[i].contact[foot];
    if ((before > kContactLimit) == (after > kContactLimit)) continue;
    const double share = (kContactLimit - before) / (after - before);
    events.push_back({side, after > before ? GaitEventKind::kFootStrike : GaitEventKind::kFootOff,
                      std::lerp(run[i - 1].time_s, run[i].time_s, share)});
  }
  return events;
}

// Removes phases of a foot that are too short for one. @param events  of this foot.
void RemoveFlicker(std::vector<GaitEvent>& events) {
  std::vector<GaitEvent> kept;
  for (const GaitEvent& event : events) {
    if (!kept.empty() && event.time_s - kept.back().time_s < kLeastPhase_s)
      kept.pop_back();
    else
      kept.push_back(event);
  }
  events = std::move(kept);
}

}  // namespace

bool HasFeet(const PoseRow& row) {
  return FurtherOf(row, Point::kHeelL).allFinite() && FurtherOf(row, Point::kHeelR).allFinite() &&
         FurtherOf(row, Point::kToeL).allFinite() && FurtherOf(row, Point::kToeR).allFinite();
}

bool HasContacts(const Result& result) {
  return std::ranges::any_of(result.poses, [](const PoseRow& row) { return HasContacts(row); });
}

std::vector<GaitRun> GaitRunsOf(const Result& result) {
  std::vector<GaitRun> runs;
  if (result.poses.size() < 2) return runs;
  const double gap_s = kGapPeriods * MedianPeriod_s(result.poses);
  const std::int64_t start_ns = result.poses.front().timestamp_ns;
  const bool by_contact = HasContacts(result);
  bool is_open = false;
  for (const PoseRow& row : result.poses) {
    if (!IsTracked(row)) is_open = false;
    if (!IsTracked(row) || !HasFeet(row) || (by_contact && !HasContacts(row))) continue;
    const GaitFrame frame = FrameOf(row, start_ns);
    if (!is_open || frame.time_s - runs.back().back().time_s > gap_s) runs.emplace_back();
    runs.back().push_back(frame);
    is_open = true;
  }
  return runs;
}

std::vector<Vector3> DirectionsOf(std::span<const GaitFrame> run) {
  std::vector<Vector3> directions;
  std::size_t begin = 0, end = 0;
  for (const GaitFrame& frame : run) {
    while (run[begin].time_s < frame.time_s - kHalfWindow_s) ++begin;
    while (end + 1 < run.size() && run[end + 1].time_s <= frame.time_s + kHalfWindow_s) ++end;
    Vector3 way = run[end].pelvis_W - run[begin].pelvis_W;
    way.z() = 0;
    const double passed_s = run[end].time_s - run[begin].time_s;
    const bool walks = way.norm() > kLeastWalking_mm_s * passed_s && passed_s > 0;
    directions.push_back(walks ? Vector3(way.normalized()) : Vector3::Zero());
  }
  return directions;
}

std::vector<GaitEvent> FindContactEvents(std::span<const GaitFrame> run) {
  std::vector<GaitEvent> events;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    std::vector<GaitEvent> of_foot = CrossingsOf(run, side);
    RemoveFlicker(of_foot);
    events.insert(events.end(), of_foot.begin(), of_foot.end());
  }
  std::ranges::stable_sort(events, {}, &GaitEvent::time_s);
  return events;
}

std::vector<GaitEvent> FindPositionEvents(std::span<const GaitFrame> run) {
  const std::vector<Vector3> directions = DirectionsOf(run);
  std::vector<GaitEvent> events;
  std::vector<double> heel_ahead(run.size()), toe_behind(run.size());
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto foot = static_cast<std::size_t>(side);
    for (std::size_t i = 0; i < run.size(); ++i) {
      const Vector3& ahead = directions[i];
      const bool walks = !ahead.isZero();
      heel_ahead[i] = walks ? ahead.dot(run[i].heel_W[foot] - run[i].pelvis_W) : std::nan("");
      toe_behind[i] = walks ? -ahead.dot(run[i].toe_W[foot] - run[i].pelvis_W) : std::nan("");
    }
    AddMaxima(run, heel_ahead, side, GaitEventKind::kFootStrike, events);
    AddMaxima(run, toe_behind, side, GaitEventKind::kFootOff, events);
  }
  std::ranges::stable_sort(events, {}, &GaitEvent::time_s);
  return events;
}

std::vector<GaitEvent> FindGaitEvents(std::span<const GaitFrame> run) {
  const bool has_contacts = !run.empty() && !std::isnan(run.front().contact[0]);
  return has_contacts ? FindContactEvents(run) : FindPositionEvents(run);
}

std::vector<GaitEvent> GaitEventsOf(const Result& result) {
  std::vector<GaitEvent> events;
  for (const GaitRun& run : GaitRunsOf(result)) {
    const std::vector<GaitEvent> found = FindGaitEvents(run);
    events.insert(events.end(), found.begin(), found.end());
  }
  return events;
}

}  // namespace mocap
