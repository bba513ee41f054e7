#include "tools/gait/gait_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace mocap {
namespace {

// A stride takes at most this long: that of steps of 250 mm at kLeastWalking_mm_s.
constexpr double kLongestStride_s = 2.5;

Side OtherOf(Side side) { return side == Side::kLeft ? Side::kRight : Side::kLeft; }

// Positions between the frames.
GaitFrame FrameAt(std::span<const GaitFrame> run, double time_s) {
  const auto after = std::ranges::lower_bound(run, time_s, {}, &GaitFrame::time_s);
  if (after == run.begin()) return run.front();
  if (after == run.end()) return run.back();
  const GaitFrame &a = *(after - 1), &b = *after;
  const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
  const auto between = [share](const Vector3& p, const Vector3& q) -> Vector3 {
    return p + share * (q - p);
  };
  GaitFrame frame{time_s, between(a.pelvis_W, b.pelvis_W), {}, {}};
  for (const std::size_t foot : {0, 1}) {
    frame.heel_W[foot] = between(a.heel_W[foot], b.heel_W[foot]);
    frame.toe_W[foot] = between(a.toe_W[foot], b.toe_W[foot]);
  }
  return frame;
}

// The times of a side's events of a kind between two others.
std::vector<double> TimesOf(std::span<const GaitEvent> events, Side side, GaitEventKind kind,
                            double after_s, double before_s) {
  std::vector<double> times_s;
  for (const GaitEvent& event : events)
    if (event.side == side && event.kind == kind && event.time_s > after_s &&
        event.time_s < before_s)
      times_s.push_back(event.time_s);
  return times_s;
}

// The stride that begins with a strike; empty if one of its events is missing.
std::optional<Stride> StrideFrom(std::span<const GaitEvent> events, const GaitEvent& begin) {
  using enum GaitEventKind;
  const Side other = OtherOf(begin.side);
  const auto ends_s =
      TimesOf(events, begin.side, kFootStrike, begin.time_s, begin.time_s + kLongestStride_s);
  if (ends_s.empty()) return std::nullopt;
  const double end_s = ends_s.front();
  const auto offs_s = TimesOf(events, begin.side, kFootOff, begin.time_s, end_s);
  const auto strikes_s = TimesOf(events, other, kFootStrike, begin.time_s, end_s);
  if (offs_s.empty() || strikes_s.empty()) return std::nullopt;
  const double opposite_strike_s = strikes_s.front();
  const double earliest_s = begin.time_s - (end_s - begin.time_s);
  const auto other_offs_s = TimesOf(events, other, kFootOff, earliest_s, opposite_strike_s);
  if (other_offs_s.empty()) return std::nullopt;
  const double opposite_off_s = other_offs_s.back();
  // An off before another strike belongs to the stance before: its own was missed.
  if (!TimesOf(events, other, kFootStrike, opposite_off_s, opposite_strike_s).empty())
    return std::nullopt;
  return Stride{.side = begin.side,
                .begin_s = begin.time_s,
                .end_s = end_s,
                .off_s = offs_s.front(),
                .opposite_strike_s = opposite_strike_s,
                .opposite_off_s = opposite_off_s};
}

void MeasureLengths(std::span<const GaitFrame> run, Stride& stride) {
  const GaitFrame begin = FrameAt(run, stride.begin_s), end = FrameAt(run, stride.end_s);
  const auto foot = static_cast<std::size_t>(stride.side);
  Vector3 line = end.heel_W[foot] - begin.heel_W[foot];
  line.z() = 0;
  const Vector3 ahead = line.normalized(), left = Vector3::UnitZ().cross(ahead);
  const GaitFrame between = FrameAt(run, stride.opposite_strike_s);
  const Vector3 step = end.heel_W[foot] - between.heel_W[1 - foot];
  stride.length_mm = line.norm();
  stride.step_length_mm = ahead.dot(step);
  // Feet that cross have a negative width.
  stride.step_width_mm = (stride.side == Side::kLeft ? 1 : -1) * left.dot(step);
  stride.speed_mm_s = (end.pelvis_W - begin.pelvis_W).head<2>().norm() / stride.duration_s();
}

MeanAndSpread Measure(std::span<const Stride> strides, Side side, const GaitFigure& figure) {
  SampleSums sums;
  for (const Stride& stride : strides)
    if (stride.side == side) sums.Add(figure.of(stride));
  return sums.Measured();
}

}  // namespace

const std::array<GaitFigure, kGaitFigureCount> kGaitFigures = {{
    {"step length", "mm", [](const Stride& s) { return s.step_length_mm; }},
    {"stride length", "mm", [](const Stride& s) { return s.length_mm; }},
    {"step width", "mm", [](const Stride& s) { return s.step_width_mm; }},
    {"step time", "s", [](const Stride& s) { return s.end_s - s.opposite_strike_s; }},
    {"stride time", "s", [](const Stride& s) { return s.duration_s(); }},
    {"cadence", "steps/min", [](const Stride& s) { return 120 / s.duration_s(); }},
    {"speed", "m/s", [](const Stride& s) { return s.speed_mm_s / 1000; }},
    {"stance", "%", [](const Stride& s) { return 100 * (s.off_s - s.begin_s) / s.duration_s(); }},
    {"swing", "%", [](const Stride& s) { return 100 * (s.end_s - s.off_s) / s.duration_s(); }},
    {"double support", "%", [](const Stride& s) { return 100 * s.both_s() / s.duration_s(); }},
    {"single support", "%",
     [](const Stride& s) { return 100 * (s.off_s - s.begin_s - s.both_s()) / s.duration_s(); }},
}};

std::vector<StancePhase> StancePhasesOf(std::span<const GaitEvent> events) {
  std::vector<StancePhase> stances;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    double strike_s = std::nan("");
    for (const GaitEvent& event : events) {
      if (event.side != side) continue;
      if (event.kind == GaitEventKind::kFootStrike) {
        strike_s = event.time_s;
      } else if (!std::isnan(strike_s)) {
        stances.push_back({side, strike_s, event.time_s});
        strike_s = std::nan("");
      }
    }
  }
  return stances;
}

std::vector<Stride> StridesOf(std::span<const GaitFrame> run, std::span<const GaitEvent> events) {
  std::vector<Stride> strides;
  for (const GaitEvent& begin : events) {
    if (begin.kind != GaitEventKind::kFootStrike) continue;
    std::optional<Stride> stride = StrideFrom(events, begin);
    if (!stride) continue;
    MeasureLengths(run, *stride);
    if (stride->speed_mm_s >= kLeastWalking_mm_s) strides.push_back(*stride);
  }
  return strides;
}

GaitSummary Summarize(std::span<const Stride> strides) {
  GaitSummary summary;
  for (std::size_t i = 0; i < kGaitFigures.size(); ++i) {
    for (const Side side : {Side::kLeft, Side::kRight})
      summary.figures[static_cast<std::size_t>(side)][i] = Measure(strides, side, kGaitFigures[i]);
    const MeanAndSpread &left = summary.figures[0][i], &right = summary.figures[1][i];
    const bool has_both = left.count > 0 && right.count > 0 && left.mean + right.mean != 0;
    summary.symmetry_percent[i] = has_both
                                      ? 200 * (left.mean - right.mean) / (left.mean + right.mean)
                                      : std::numeric_limits<double>::quiet_NaN();
  }
  return summary;
}

}  // namespace mocap
