// Smooth curves through keys: joint angles and paths over time.
#pragma once

#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "core/geometry.h"

namespace mocap::simulation {

inline constexpr double kTurn = 2 * std::numbers::pi;

struct Key {
  double t = 0;
  double v = 0;
};

/// Interpolates keys without overshoot and with a continuous slope (Fritsch and Carlson 1980).
///
/// @param keys    at least two, t increasing.
/// @param period  0: the ends hold; else the curve repeats, and the last key lies before
///                keys.front().t + period.
double Evaluate(std::span<const Key> keys, double t, double period = 0);

/// 0 before `low`, 1 after `high`, with a smooth transition.
double Smoothstep(double low, double high, double t);

/// Remainder in [0, period).
double Wrap(double t, double period);

/// A curve on the floor, parametrized by distance.
class FloorPath {
 public:
  /// @param points  close together; the last point of a closed path is next to the first.
  FloorPath(std::vector<Vector2> points, bool closed);

  double length_mm() const { return length_mm_; }
  /// Beyond [0, length], a closed path repeats and an open path stays at its end.
  Vector2 PositionAt(double distance_mm) const;
  /// Direction of travel [rad], continuous over any number of rounds.
  double HeadingAt(double distance_mm) const;

 private:
  struct Place {
    double rounds, index, share;
  };
  Place PlaceAt(double distance_mm) const;

  std::vector<Vector2> points_;
  std::vector<double> distances_, headings_;
  double length_mm_ = 0, round_rad_ = 0;
  bool closed_;
};

/// An oval with waves in its radius, so that its curvature varies everywhere.
FloorPath OvalPath(const Vector2& center, double radius_mm, std::uint64_t seed);

/// Two loops that cross at right angles in the middle.
/// @param radius_mm  of each loop; the path extends 2.4 times as far from the middle.
FloorPath FigureEight(const Vector2& center, double radius_mm, double turned_rad);

/// A smooth open curve through waypoints.
FloorPath SplinePath(std::span<const Vector2> waypoints);

/// A smooth closed curve through waypoints, from the last back to the first.
FloorPath RoundPath(std::span<const Vector2> waypoints);

/// A walk with gentle start and stop: speed rises and falls linearly.
struct EasedWalk {
  double way_mm = 0, speed_mm_s = 0, ease_s = 0;

  double duration_s() const { return way_mm / speed_mm_s + ease_s; }
  /// Distance covered after a time; 0 before 0, the whole way after the duration.
  double WayAt(double t_s) const;
};

}  // namespace mocap::simulation
