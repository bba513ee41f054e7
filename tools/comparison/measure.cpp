#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/degrees.h"
#include "core/quantile.h"
#include "tools/comparison/comparison.h"
#include "tools/comparison/speed_correlation.h"

namespace mocap {
namespace {

struct MeasuredMoments {
  const ResultMotion& own;
  const RecordedMotion& other;
  const Alignment& alignment;
  std::vector<SharedMoment> moments;
};

double SpeedCorrelationOf(const MeasuredMoments& at, const PointPair& pair) {
  const double step_s = CoarseStep(at.own.motion, at.other);
  const TimeGrid own_grid = GridOf(at.own.motion, step_s);
  TimeGrid other_grid = own_grid;
  other_grid.first_s -= at.alignment.offset_s;
  return CorrelationOf(SpeedOf(Resampled(at.own.motion, {pair.point, *pair.own}, own_grid), step_s),
                       SpeedOf(Resampled(at.other, {pair.point, pair.other}, other_grid), step_s));
}

/// Of the lengths of vectors, less a constant one.
Agreement AgreementOfLengths(const std::vector<Vector3>& vectors, const Vector3& less) {
  std::vector<double> lengths;
  for (const Vector3& vector : vectors) lengths.push_back((vector - less).norm());
  return AgreementOf(lengths);
}

PointComparison MeasurePoint(const MeasuredMoments& at, const PointPair& pair) {
  PointComparison point{.point = pair.point, .others = pair.others};
  std::vector<Vector3> apart_S;
  for (const SharedMoment& moment : at.moments) {
    const Vector3 own_W = PointAt(*pair.own, moment.own);
    const Vector3 other_W = at.alignment.X * PointAt(pair.other, moment.other);
    const Matrix3& R_WS =
        at.own.R_WS[NearestFrame(moment.own)][static_cast<std::size_t>(pair.segment)];
    apart_S.push_back(R_WS.transpose() * (own_W - other_W));
    point.own_W.push_back(own_W);
    point.other_W.push_back(other_W);
  }
  Vector3 bias_S;
  for (int axis = 0; axis < 3; ++axis) {
    Agreement& agreement = point.axes[static_cast<std::size_t>(axis)];
    agreement = AgreementOf(AxisOf(apart_S, axis));
    bias_S[axis] = agreement.bias;
  }
  point.distance = AgreementOfLengths(apart_S, Vector3::Zero());
  point.rmsd_without_bias = AgreementOfLengths(apart_S, bias_S).rmsd;
  point.speed_correlation = SpeedCorrelationOf(at, pair);
  return point;
}

/// Moves a curve by whole turns to another one.
void MoveByTurns(const std::vector<double>& own, std::vector<double>& other) {
  std::vector<double> apart;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (std::isfinite(own[i] - other[i])) apart.push_back(own[i] - other[i]);
  if (apart.empty()) return;
  const double turns = 360 * std::round(MedianOf(apart) / 360);
  for (double& deg : other) deg += turns;
}

void FinishAngle(AngleComparison& angle) {
  MoveByTurns(angle.own_deg, angle.other_deg);
  std::vector<double> apart;
  for (std::size_t i = 0; i < angle.own_deg.size(); ++i)
    apart.push_back(angle.own_deg[i] - angle.other_deg[i]);
  angle.agreement = AgreementOf(apart);
  angle.correlation = CorrelationOf(angle.own_deg, angle.other_deg);
  angle.multiple_correlation = MultipleCorrelationOf(angle.own_deg, angle.other_deg);
}

/// Whether a curve changes: programs write coordinates that were not measured as constants.
bool Changes(const std::vector<double>& deg) {
  const auto is_known = [](double value) { return std::isfinite(value); };
  const auto first = std::ranges::find_if(deg, is_known);
  return std::any_of(first, deg.end(), [&](double value) {
    return is_known(value) && std::abs(value - *first) > 1e-6;
  });
}

void MeasureAngles(const MeasuredMoments& at, const std::vector<AnglePair>& angles,
                   Comparison& comparison) {
  for (const AnglePair& pair : angles) {
    const AngleCurve* own = at.own.motion.FindAngle(pair.own);
    const AngleCurve* other = at.other.FindAngle(pair.other);
    if (own == nullptr || other == nullptr || !Changes(other->deg)) continue;
    AngleComparison angle;
    angle.angle = pair.own;
    angle.other = pair.other;
    for (const SharedMoment& moment : at.moments) {
      angle.own_deg.push_back(AngleAt(own->deg, moment.own));
      angle.other_deg.push_back(pair.sign * AngleAt(other->deg, moment.other));
    }
    FinishAngle(angle);
    if (angle.agreement.count > 0) comparison.angles.push_back(std::move(angle));
  }
}

/// The bend at the middle one of three points; straight: 0.
struct Bend {
  std::string_view name, above, at, below;
};
/// The first that both recordings have. Lower arms and soles lie on the prolonged limb.
constexpr std::array kBends = {Bend{"hip", "neck", "hip", "knee"},
                               Bend{"knee", "hip", "knee", "ankle"},
                               Bend{"knee", "hip", "knee", "foot"},
                               Bend{"ankle", "knee", "ankle", "ball"},
                               Bend{"ankle", "knee", "ankle", "toe"},
                               Bend{"elbow", "shoulder", "elbow", "wrist"},
                               Bend{"elbow", "shoulder", "elbow", "lower_arm"}};

double BendOf(const Vector3& above, const Vector3& at, const Vector3& below) {
  const Vector3 upper = above - at, lower = below - at;
  return 180 - kDegreesPerRad * std::atan2(upper.cross(lower).norm(), upper.dot(lower));
}

void MeasureBends(Comparison& comparison) {
  const auto find = [&](std::string_view name, const char* side) -> const PointComparison* {
    const auto point = std::ranges::find_if(comparison.points, [&](const PointComparison& one) {
      return one.point == std::string(name) + side || one.point == name;
    });
    return point == comparison.points.end() ? nullptr : &*point;
  };
  for (const char* side : {"_l", "_r"}) {
    for (const Bend& bend : kBends) {
      const std::string name = "bend of " + std::string(bend.name) + side;
      const PointComparison *above = find(bend.above, side), *at = find(bend.at, side),
                            *below = find(bend.below, side);
      if (!above || !at || !below ||
          std::ranges::find(comparison.angles, name, &AngleComparison::angle) !=
              comparison.angles.end())
        continue;
      AngleComparison angle;
      angle.angle = name;
      for (std::size_t i = 0; i < comparison.time_s.size(); ++i) {
        angle.own_deg.push_back(BendOf(above->own_W[i], at->own_W[i], below->own_W[i]));
        angle.other_deg.push_back(BendOf(above->other_W[i], at->other_W[i], below->other_W[i]));
      }
      FinishAngle(angle);
      if (angle.agreement.count > 0) comparison.angles.push_back(std::move(angle));
    }
  }
}

std::size_t CountOf(const PointComparison& point) { return point.distance.count; }
std::size_t CountOf(const AngleComparison& angle) { return angle.agreement.count; }

/// The mean of a value of several figures, by their numbers of moments.
template <typename Figure, typename Value>
double PooledMean(const std::vector<Figure>& figures, const Value& value) {
  double sum = 0, count = 0;
  for (const Figure& figure : figures) {
    sum += static_cast<double>(CountOf(figure)) * value(figure);
    count += static_cast<double>(CountOf(figure));
  }
  return count > 0 ? sum / count : kUnmeasured;
}

template <typename Figure, typename Value>
double PooledRms(const std::vector<Figure>& figures, const Value& value) {
  return std::sqrt(PooledMean(figures, [&](const Figure& f) { return std::pow(value(f), 2); }));
}

void Summarize(Comparison& comparison) {
  using Point = PointComparison;
  using Angle = AngleComparison;
  const std::vector<Point>& points = comparison.points;
  const std::vector<Angle>& angles = comparison.angles;
  comparison.points_mean_mm = PooledMean(points, [](const Point& p) { return p.distance.bias; });
  comparison.points_rmsd_mm = PooledRms(points, [](const Point& p) { return p.distance.rmsd; });
  comparison.points_rmsd_without_bias_mm =
      PooledRms(points, [](const Point& p) { return p.rmsd_without_bias; });
  comparison.angles_rmsd_deg = PooledRms(angles, [](const Angle& a) { return a.agreement.rmsd; });
  comparison.angles_rmsd_without_bias_deg =
      PooledRms(angles, [](const Angle& a) { return a.agreement.rmsd_without_bias; });
}

}  // namespace

void Measure(const ResultMotion& own, const RecordedMotion& other,
             const std::vector<AnglePair>& angles, Comparison& comparison) {
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  const Alignment& alignment = comparison.alignment;
  const MeasuredMoments at{own, other, alignment,
                           SharedMoments(own.motion, other, alignment.offset_s, kAll)};
  for (const SharedMoment& moment : at.moments) comparison.time_s.push_back(moment.time_s);
  for (const PointPair& pair : alignment.pairs) {
    PointComparison point = MeasurePoint(at, pair);
    if (point.distance.count > 0) comparison.points.push_back(std::move(point));
  }
  MeasureAngles(at, angles, comparison);
  comparison.angles_by_points = comparison.angles.empty();
  if (comparison.angles_by_points) MeasureBends(comparison);
  Summarize(comparison);
}

}  // namespace mocap
