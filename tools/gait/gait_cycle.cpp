#include "tools/gait/gait_cycle.h"

#include <algorithm>
#include <cmath>

#include "core/degrees.h"

namespace mocap {
namespace {

using Coordinates = std::array<double, kCoordinateNames.size()>;

struct TimedCoordinates {
  double time_s;
  Coordinates rad;
};

Coordinates At(std::span<const TimedCoordinates> frames, double time_s) {
  const auto after = std::ranges::lower_bound(frames, time_s, {}, &TimedCoordinates::time_s);
  if (after == frames.begin()) return frames.front().rad;
  if (after == frames.end()) return frames.back().rad;
  const TimedCoordinates &a = *(after - 1), &b = *after;
  Coordinates rad;
  for (std::size_t i = 0; i < rad.size(); ++i)
    rad[i] = std::lerp(a.rad[i], b.rad[i], (time_s - a.time_s) / (b.time_s - a.time_s));
  return rad;
}

bool IsOf(std::string_view coordinate, Side side) {
  const std::string_view other = side == Side::kLeft ? "_r" : "_l";
  return !coordinate.ends_with(other);
}

// Sums of a coordinate and of its square at each percent.
struct CycleSums {
  std::array<double, kCycleSamples> sum{}, squares{};
};

CycleCurve CurveOf(std::string_view name, Side side, int strides, const CycleSums& sums) {
  CycleCurve curve{std::string(name), side, strides};
  for (int percent = 0; percent < kCycleSamples; ++percent) {
    const double mean = sums.sum[percent] / strides;
    curve.mean_deg[percent] = mean;
    const double rest = std::max(0.0, sums.squares[percent] - sums.sum[percent] * mean);
    if (strides > 1) curve.spread_deg[percent] = std::sqrt(rest / (strides - 1));
  }
  return curve;
}

void AddCurves(std::span<const TimedCoordinates> frames, std::span<const Stride> strides, Side side,
               std::vector<CycleCurve>& curves) {
  std::array<CycleSums, kCoordinateNames.size()> sums;
  int count = 0;
  for (const Stride& stride : strides) {
    if (stride.side != side) continue;
    ++count;
    for (int percent = 0; percent < kCycleSamples; ++percent) {
      const double share = static_cast<double>(percent) / (kCycleSamples - 1);
      const Coordinates rad = At(frames, std::lerp(stride.begin_s, stride.end_s, share));
      for (std::size_t i = 0; i < rad.size(); ++i) {
        const double deg = rad[i] * kDegreesPerRad;
        sums[i].sum[percent] += deg;
        sums[i].squares[percent] += deg * deg;
      }
    }
  }
  if (count == 0) return;
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (IsOf(kCoordinateNames[i], side))
      curves.push_back(CurveOf(kCoordinateNames[i], side, count, sums[i]));
}

// Someone who turns on the way has the same gait: the pelvis is in the walker's frame.
Coordinates InWalkersFrame(BodyAngles angles) {
  angles.pelvis = angles.walker_pelvis;
  return CoordinatesOf(angles);
}

}  // namespace

std::vector<CycleCurve> CurvesOf(std::span<const BodyAngles> angles, std::int64_t start_ns,
                                 std::span<const Stride> strides) {
  std::vector<TimedCoordinates> frames;
  for (const BodyAngles& one : angles)
    frames.push_back({static_cast<double>(one.time_ns - start_ns) * 1e-9, InWalkersFrame(one)});
  std::vector<CycleCurve> curves;
  if (frames.empty()) return curves;
  for (const Side side : {Side::kLeft, Side::kRight}) AddCurves(frames, strides, side, curves);
  return curves;
}

}  // namespace mocap
