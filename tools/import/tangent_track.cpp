#include "tools/import/tangent_track.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/quantile.h"

namespace mocap {
namespace {

constexpr float kNotSeen = std::numeric_limits<float>::quiet_NaN();
/// Frames farther apart than so many usual intervals have a gap between them.
constexpr double kGapIntervals = 2.5;
/// A person who fills more of all planes stands before the other camera, or is all around it.
constexpr double kWidest_rad = std::numbers::pi / 2;

/// Lenses that are closer have no line between them.
constexpr double kLeastBaseline_mm = 100;

/// Planes through a line, by their angle about it.
struct Pencil {
  Vector3 axis, zero, quarter;

  double AngleOf(const Vector3& ray) const { return std::atan2(ray.dot(quarter), ray.dot(zero)); }
  /// Sine of the angle between the ray and the line.
  double SineOf(const Vector3& ray) const { return std::hypot(ray.dot(quarter), ray.dot(zero)); }
};

/// Everybody whom either camera sees, in the mean.
Vector3 MeanRay(const CameraHulls& camera) {
  Vector3 sum = Vector3::Zero();
  for (const SeenHull& frame : camera.frames)
    for (const HullCorner& corner : frame.corners) sum += corner.ray_W;
  return sum;
}

/// @param towards  gets the angle 0, far from where angles jump.
Pencil PencilOf(const Vector3& line, const Vector3& towards) {
  Pencil pencil;
  pencil.axis = line.normalized();
  Vector3 zero = towards - towards.dot(pencil.axis) * pencil.axis;
  if (zero.norm() < 1e-9 * (1 + towards.norm())) zero = pencil.axis.unitOrthogonal();
  pencil.zero = zero.normalized();
  pencil.quarter = pencil.axis.cross(pencil.zero);
  return pencil;
}

TangentTrack::Touch TouchOf(const SeenHull& hull, const Pencil& pencil, double pixel_rad) {
  TangentTrack::Touch touch{{kNotSeen, kNotSeen}, {1, 1}};
  if (hull.corners.empty()) return touch;
  const HullCorner* ends[2] = {nullptr, nullptr};
  std::array<double, 2> angles{};
  for (const HullCorner& corner : hull.corners) {
    const double angle = pencil.AngleOf(corner.ray_W);
    if (!ends[0] || angle < angles[0]) ends[0] = &corner, angles[0] = angle;
    if (!ends[1] || angle > angles[1]) ends[1] = &corner, angles[1] = angle;
  }
  if (angles[1] - angles[0] > kWidest_rad) return touch;
  for (int side = 0; side < 2; ++side) {
    if (ends[side]->is_at_edge) continue;
    touch.angle_rad[side] = static_cast<float>(angles[side]);
    touch.pixel_rad[side] =
        static_cast<float>(pixel_rad / std::max(pencil.SineOf(ends[side]->ray_W), pixel_rad));
  }
  return touch;
}

TangentTrack TrackOf(const CameraHulls& camera, const Pencil& pencil) {
  TangentTrack track;
  for (const SeenHull& frame : camera.frames) {
    track.times_s.push_back(frame.time_s);
    track.touches.push_back(TouchOf(frame, pencil, camera.pixel_rad));
  }
  return track;
}

double LongestInterval(const TangentTrack& track) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < track.times_s.size(); ++i)
    intervals.push_back(track.times_s[i] - track.times_s[i - 1]);
  return intervals.empty() ? 0 : kGapIntervals * MedianOf(intervals);
}

TangentTrack::Touch Between(const TangentTrack& track, std::size_t i, double time_s) {
  const TangentTrack::Touch &a = track.touches[i], &b = track.touches[i + 1];
  const auto share =
      static_cast<float>((time_s - track.times_s[i]) / (track.times_s[i + 1] - track.times_s[i]));
  TangentTrack::Touch touch{};
  for (int side = 0; side < 2; ++side) {
    touch.angle_rad[side] = a.angle_rad[side] + share * (b.angle_rad[side] - a.angle_rad[side]);
    touch.pixel_rad[side] = a.pixel_rad[side] + share * (b.pixel_rad[side] - a.pixel_rad[side]);
  }
  return touch;
}

}  // namespace

TangentPair TangentsOf(const CameraHulls& first, const CameraHulls& second) {
  if ((second.lens_W - first.lens_W).norm() < kLeastBaseline_mm) return {};
  const Vector3 towards = MeanRay(first).normalized() + MeanRay(second).normalized();
  const Pencil pencil = PencilOf(second.lens_W - first.lens_W, towards);
  TangentPair pair{TrackOf(first, pencil), TrackOf(second, pencil)};
  // Across a gap nothing is known: a frame that sees nothing marks it.
  for (TangentTrack* track : {&pair.first, &pair.second}) {
    const double longest_s = LongestInterval(*track);
    for (std::size_t i = 0; i + 1 < track->times_s.size(); ++i) {
      if (track->times_s[i + 1] - track->times_s[i] > longest_s)
        track->touches[i] = {{kNotSeen, kNotSeen}, {1, 1}};
    }
  }
  return pair;
}

TangentTrack::Touch TouchAt(const TangentTrack& track, double time_s, std::size_t& at) {
  const auto& times = track.times_s;
  if (times.size() < 2 || !(time_s >= times.front() && time_s < times.back()))
    return {{kNotSeen, kNotSeen}, {1, 1}};
  while (times[at + 1] <= time_s) ++at;
  return Between(track, at, time_s);
}

SampledTrack Sample(const TangentTrack& track, double step_s) {
  SampledTrack sampled{0, step_s, {}};
  if (track.times_s.size() < 2) return sampled;
  sampled.begin_s = track.times_s.front();
  const double length_s = track.times_s.back() - sampled.begin_s;
  std::size_t at = 0;
  for (int i = 0; i * step_s < length_s; ++i)
    sampled.touches.push_back(TouchAt(track, sampled.begin_s + i * step_s, at));
  return sampled;
}

}  // namespace mocap
