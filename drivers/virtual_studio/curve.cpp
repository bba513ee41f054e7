#include "drivers/virtual_studio/curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/virtual_studio/random.h"

namespace mocap::simulation {
namespace {

constexpr int kPathSamples = 2048;
// Half length of the rounding of corners; for a figure eight, in radii.
constexpr double kRoundedOff_mm = 480, kEightRoundedOff = 0.35;

// Slope at the middle of three keys: a weighted harmonic mean, flat at a turning point.
double Slope(const Key& a, const Key& b, const Key& c) {
  const double h0 = b.t - a.t, h1 = c.t - b.t;
  const double d0 = (b.v - a.v) / h0, d1 = (c.v - b.v) / h1;
  if (d0 * d1 <= 0) return 0;
  const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}

struct PlaneKeys {
  std::vector<Key> x, y;  // Over the distance between waypoints.
};

PlaneKeys KeysThrough(std::span<const Vector2> waypoints) {
  PlaneKeys keys;
  double t = 0;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    if (i > 0) t += (waypoints[i] - waypoints[i - 1]).norm();
    keys.x.push_back({t, waypoints[i].x()});
    keys.y.push_back({t, waypoints[i].y()});
  }
  return keys;
}

// Three passes of a moving average of ±`half_mm` along a closed path.
std::vector<Vector2> SmoothedRound(std::vector<Vector2> points, double round_mm, double half_mm) {
  const int count = static_cast<int>(points.size());
  const int half = static_cast<int>(half_mm / round_mm * count);
  for (int pass = 0; pass < 3; ++pass) {
    std::vector<Vector2> smooth;
    for (int i = 0; i < count; ++i) {
      Vector2 sum = Vector2::Zero();
      for (int k = i - half; k <= i + half; ++k) sum += points[(k + count) % count];
      smooth.push_back(sum / (2 * half + 1));
    }
    points = std::move(smooth);
  }
  return points;
}

}  // namespace

double Evaluate(std::span<const Key> keys, double t, double period) {
  const int n = static_cast<int>(keys.size());
  if (period > 0) {
    t = keys.front().t + Wrap(t - keys.front().t, period);
  } else if (t <= keys.front().t) {
    return keys.front().v;
  } else if (t >= keys.back().t) {
    return keys.back().v;
  }
  int i = 0;
  while (i + 1 < n && keys[i + 1].t <= t) ++i;
  const auto key = [&](int k) {
    if (period > 0) {
      const int round = k < 0 ? -1 : k / n;
      return Key{keys[k - round * n].t + round * period, keys[k - round * n].v};
    }
    return keys[std::clamp(k, 0, n - 1)];
  };
  const Key b = key(i), c = key(i + 1);
  const bool open = period <= 0;
  const double m0 = open && i == 0 ? 0 : Slope(key(i - 1), b, c);
  const double m1 = open && i + 2 >= n ? 0 : Slope(b, c, key(i + 2));
  const double h = c.t - b.t, u = (t - b.t) / h, u2 = u * u, u3 = u2 * u;
  return (2 * u3 - 3 * u2 + 1) * b.v + (u3 - 2 * u2 + u) * h * m0 + (3 * u2 - 2 * u3) * c.v +
         (u3 - u2) * h * m1;
}

double Smoothstep(double low, double high, double t) {
  const double u = std::clamp((t - low) / (high - low), 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

double Wrap(double t, double period) { return t - period * std::floor(t / period); }

FloorPath::FloorPath(std::vector<Vector2> points, bool closed)
    : points_(std::move(points)), closed_(closed) {
  if (closed_) points_.push_back(points_.front());
  const int n = static_cast<int>(points_.size());
  const double turn = 2 * std::numbers::pi;
  for (int i = 0; i < n; ++i) {
    distances_.push_back(i == 0 ? 0 : distances_.back() + (points_[i] - points_[i - 1]).norm());
    const int before = i > 0 ? i - 1 : (closed_ ? n - 2 : 0);
    const int after = i + 1 < n ? i + 1 : (closed_ ? 1 : n - 1);
    const Vector2 tangent = points_[after] - points_[before];
    const double heading = std::atan2(tangent.y(), tangent.x());
    headings_.push_back(i == 0 ? heading
                               : heading + turn * std::round((headings_.back() - heading) / turn));
  }
  length_mm_ = distances_.back();
  round_rad_ = closed_ ? headings_.back() - headings_.front() : 0;
}

FloorPath::Place FloorPath::PlaceAt(double distance_mm) const {
  const double rounds = closed_ ? std::floor(distance_mm / length_mm_) : 0;
  const double d = std::clamp(distance_mm - rounds * length_mm_, 0.0, length_mm_);
  const auto after = std::upper_bound(distances_.begin() + 1, distances_.end() - 1, d);
  return {rounds, static_cast<double>(after - distances_.begin()) - 1,
          (d - *(after - 1)) / (*after - *(after - 1))};
}

Vector2 FloorPath::PositionAt(double distance_mm) const {
  const Place place = PlaceAt(distance_mm);
  const auto i = static_cast<std::size_t>(place.index);
  return (1 - place.share) * points_[i] + place.share * points_[i + 1];
}

double FloorPath::HeadingAt(double distance_mm) const {
  const Place place = PlaceAt(distance_mm);
  const auto i = static_cast<std::size_t>(place.index);
  return (1 - place.share) * headings_[i] + place.share * headings_[i + 1] +
         place.rounds * round_rad_;
}

FloorPath OvalPath(const Vector2& center, double radius_mm, std::uint64_t seed) {
  Random random(Mix(seed, Tag("oval")));
  const double direction = random.Uniform(0, 1) < 0.5 ? 1 : -1;
  const double phase2 = random.Uniform(0, 2 * std::numbers::pi);
  const double phase3 = random.Uniform(0, 2 * std::numbers::pi);
  std::vector<Vector2> points;
  for (int i = 0; i < kPathSamples; ++i) {
    const double a = 2 * std::numbers::pi * i / kPathSamples;
    const double r =
        radius_mm * (1 + 0.14 * std::cos(2 * a + phase2) + 0.05 * std::cos(3 * a + phase3));
    points.push_back(center + r * Vector2(std::cos(a), direction * std::sin(a)));
  }
  return {std::move(points), true};
}

FloorPath FigureEight(const Vector2& center, double radius_mm, double turned_rad) {
  // Straight through the middle, three quarters of a circle, straight back, then mirrored.
  const double straight_mm = 2 * radius_mm, arc_mm = 1.5 * std::numbers::pi * radius_mm;
  const double half_mm = straight_mm + arc_mm;
  const auto loop = [&](double s) -> Vector2 {
    const double along = s - radius_mm;
    if (along < 0 || along > arc_mm) {
      const double from_middle = along < 0 ? s : s - half_mm;
      return std::sqrt(0.5) * Vector2(std::abs(from_middle), from_middle);
    }
    const double angle = 0.75 * std::numbers::pi - along / radius_mm;
    return radius_mm * Vector2(std::numbers::sqrt2 + std::cos(angle), std::sin(angle));
  };
  const Eigen::Rotation2Dd turn(turned_rad);
  std::vector<Vector2> points;
  for (int i = 0; i < kPathSamples; ++i) {
    const double s = 2 * half_mm * i / kPathSamples;
    const bool is_first = s < half_mm;
    const Vector2 p = loop(is_first ? s : s - half_mm);
    points.push_back(center + turn * Vector2(is_first ? p.x() : -p.x(), p.y()));
  }
  return {SmoothedRound(std::move(points), 2 * half_mm, kEightRoundedOff * radius_mm), true};
}

FloorPath RoundPath(std::span<const Vector2> waypoints) {
  const auto [x, y] = KeysThrough(waypoints);
  const double round_mm = x.back().t + (waypoints.front() - waypoints.back()).norm();
  std::vector<Vector2> points;
  for (int i = 0; i < kPathSamples; ++i) {
    const double t = round_mm * i / kPathSamples;
    points.emplace_back(Evaluate(x, t, round_mm), Evaluate(y, t, round_mm));
  }
  return {SmoothedRound(std::move(points), round_mm, kRoundedOff_mm), true};
}

double EasedWalk::WayAt(double t_s) const {
  if (t_s <= 0) return 0;
  if (t_s >= duration_s()) return way_mm;
  if (t_s < ease_s) return speed_mm_s * t_s * t_s / (2 * ease_s);
  const double left_s = duration_s() - t_s;
  if (left_s < ease_s) return way_mm - speed_mm_s * left_s * left_s / (2 * ease_s);
  return speed_mm_s * (t_s - ease_s / 2);
}

FloorPath SplinePath(std::span<const Vector2> waypoints) {
  const auto [x, y] = KeysThrough(waypoints);
  std::vector<Vector2> points;
  for (int i = 0; i < kPathSamples; ++i) {
    const double t = x.back().t * i / (kPathSamples - 1);
    points.emplace_back(Evaluate(x, t), Evaluate(y, t));
  }
  // Corners at the keys are rounded: a moving average along the path.
  for (int pass = 0; pass < 3; ++pass) {
    std::vector<Vector2> smooth = points;
    constexpr int kHalf = kPathSamples / 40;
    for (int i = 1; i + 1 < kPathSamples; ++i) {
      const int half = std::min({kHalf, i, kPathSamples - 1 - i});
      Vector2 sum = Vector2::Zero();
      for (int k = i - half; k <= i + half; ++k) sum += points[k];
      smooth[i] = sum / (2 * half + 1);
    }
    points = std::move(smooth);
  }
  return {std::move(points), false};
}

}  // namespace mocap::simulation
