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

// Of a coordinate, at each percent.
using CycleSums = std::array<SampleSums, kCycleSamples>;

// Adds the curve of a coordinate that all strides show.
void AddCurve(std::string_view name, Side side, const CycleSums& sums,
              std::vector<CycleCurve>& curves) {
  CycleCurve curve{std::string(name), side};
  for (int percent = 0; percent < kCycleSamples; ++percent) {
    const MeanAndSpread measured = sums[percent].Measured();
    if (measured.count == 0 || std::isnan(measured.mean)) return;
    curve.strides = measured.count;
    curve.mean_deg[percent] = measured.mean;
    curve.spread_deg[percent] = measured.spread;
  }
  curves.push_back(std::move(curve));
}

void AddCurves(std::span<const TimedCoordinates> frames, std::span<const Stride> strides, Side side,
               std::vector<CycleCurve>& curves) {
  std::array<CycleSums, kCoordinateNames.size()> sums;
  for (const Stride& stride : strides) {
    if (stride.side != side) continue;
    for (int percent = 0; percent < kCycleSamples; ++percent) {
      const double share = static_cast<double>(percent) / (kCycleSamples - 1);
      const Coordinates rad = At(frames, std::lerp(stride.begin_s, stride.end_s, share));
      for (std::size_t i = 0; i < rad.size(); ++i) sums[i][percent].Add(rad[i] * kDegreesPerRad);
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (IsOf(kCoordinateNames[i], side)) AddCurve(kCoordinateNames[i], side, sums[i], curves);
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
