#include "core/evaluation/accuracy.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <vector>

#include "core/errors.h"

namespace mocap {
namespace {

// Columns of ScoredPoints. Left and right are adjacent.
enum Column {
  kHead,
  kNeck,
  kShoulder,
  kElbow = 4,
  kFingertips = 6,
  kHip = 8,
  kKnee = 10,
  kFoot = 12
};

/// Column of the other end of the bone that ends at each point.
constexpr std::array<int, kScoredPointCount> kBoneStart = {
    kNeck,      kHead, kElbow,    kElbow + 1, kShoulder, kShoulder + 1, kElbow,
    kElbow + 1, kKnee, kKnee + 1, kHip,       kHip + 1,  kKnee,         kKnee + 1};

double AngleBetween(const Vector3& a, const Vector3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Vector3 TorsoAxis(const ScoredPoints& p) {
  return p.col(kNeck) - (p.col(kHip) + p.col(kHip + 1)) / 2;
}

/// Rows: along the bone that ends at the point; across it, close to the hip line; and the third
/// axis.
Matrix3 BoneFrame(const ScoredPoints& p, int point) {
  const Vector3 along = (p.col(point) - p.col(kBoneStart[point])).stableNormalized();
  const auto across = [&](const Vector3& v) -> Vector3 { return v - along * along.dot(v); };
  const Vector3 left = p.col(kHip) - p.col(kHip + 1);
  Vector3 second = across(left);
  // A bone along the hip line needs another reference direction.
  if (second.norm() < 0.2 * left.norm()) second = across(TorsoAxis(p));
  second.stableNormalize();
  Matrix3 rows;
  rows << along.transpose(), second.transpose(), along.cross(second).transpose();
  return rows;
}

double Percentile(const std::vector<double>& sorted, double share) {
  const auto place = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  return sorted[std::min(sorted.size() - 1, place)];
}

std::size_t NearestInTime(std::span<const ScoredFrame> truth, std::int64_t time_ns) {
  const auto nearest = std::ranges::min_element(
      truth, {}, [&](const ScoredFrame& frame) { return std::abs(frame.timestamp_ns - time_ns); });
  return static_cast<std::size_t>(nearest - truth.begin());
}

/// Matches each true frame with at most one frame of the output.
struct Match {
  int pose, truth;
};
std::vector<Match> MatchByTime(std::span<const ScoredFrame> truth,
                               std::span<const ScoredFrame> output) {
  const double intervals = std::max<double>(1, static_cast<double>(truth.size()) - 1);
  const double period_ns =
      static_cast<double>(truth.back().timestamp_ns - truth.front().timestamp_ns) / intervals;
  std::vector<bool> used(truth.size());
  std::vector<Match> matches;
  for (std::size_t i = 0; i < output.size(); ++i) {
    const std::size_t k = NearestInTime(truth, output[i].timestamp_ns);
    const auto apart_ns =
        static_cast<double>(std::abs(truth[k].timestamp_ns - output[i].timestamp_ns));
    if (apart_ns > period_ns / 2 || used[k]) continue;
    used[k] = true;
    matches.push_back({static_cast<int>(i), static_cast<int>(k)});
  }
  return matches;
}

/// Mean distance of each point from its own mean offset in its bone's frame.
double Spread(std::span<const FrameError> frames, std::span<const ScoredFrame> truth,
              std::span<const ScoredFrame> output) {
  double sum = 0;
  for (int point = 0; point < kScoredPointCount; ++point) {
    Eigen::Matrix3Xd offsets(3, static_cast<Eigen::Index>(frames.size()));
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const ScoredPoints& p = truth[frames[i].truth].points_W;
      offsets.col(static_cast<Eigen::Index>(i)) =
          BoneFrame(p, point) * (output[frames[i].pose].points_W.col(point) - p.col(point));
    }
    const Vector3 mean = offsets.rowwise().mean();
    sum += (offsets.colwise() - mean).colwise().norm().mean();
  }
  return sum / kScoredPointCount;
}

}  // namespace

ScoredPoints ScoredPointsOf(const BodyPoints& points_W) {
  ScoredPoints scored;
  for (int i = 0; i < kScoredPointCount; ++i) {
    scored.col(i) = points_W.col(static_cast<int>(kScoredPoints[i]));
  }
  return scored;
}

ScoredAngles ScoredAnglesOf(const ScoredPoints& p) {
  const Vector3 up = TorsoAxis(p);
  ScoredAngles angles;
  for (int side = 0; side < 2; ++side) {
    const auto bone = [&](int from, int to) -> Vector3 {
      return p.col(to + side) - p.col(from + side);
    };
    angles[side] = AngleBetween(bone(kElbow, kShoulder), bone(kElbow, kFingertips));
    angles[2 + side] = AngleBetween(bone(kKnee, kHip), bone(kKnee, kFoot));
    angles[4 + side] = AngleBetween(up, bone(kShoulder, kElbow));
    angles[6 + side] = AngleBetween(up, bone(kHip, kKnee));
  }
  return angles;
}

DistanceSummary SummarizeDistances(std::vector<double> distances_mm) {
  std::ranges::sort(distances_mm);
  DistanceSummary summary;
  for (const double distance_mm : distances_mm)
    summary.mean += distance_mm / static_cast<double>(distances_mm.size());
  summary.median = Percentile(distances_mm, 0.5);
  summary.p95 = Percentile(distances_mm, 0.95);
  summary.worst = distances_mm.back();
  return summary;
}

Accuracy MeasureAccuracy(std::span<const ScoredFrame> truth, std::span<const ScoredFrame> output) {
  MOCAP_CHECK(!truth.empty());
  Accuracy result;
  result.truth_frames = static_cast<int>(truth.size());
  result.point_mm.setZero();
  result.angle_rad.setZero();
  std::vector<double> distances;
  int heads_found = 0;
  for (const Match& match : MatchByTime(truth, output)) {
    if (!output[match.pose].tracked) continue;
    const ScoredPoints& p = output[match.pose].points_W;
    const ScoredPoints& q = truth[match.truth].points_W;
    FrameError error{match.pose, match.truth, (p - q).colwise().norm().transpose(),
                     (ScoredAnglesOf(p) - ScoredAnglesOf(q)).cwiseAbs()};
    result.point_mm += error.point_mm;
    result.angle_rad += error.angle_rad;
    distances.insert(distances.end(), error.point_mm.begin(), error.point_mm.end());
    heads_found += error.point_mm[kHead] <= kHeadFoundMm;
    result.frames.push_back(std::move(error));
  }
  if (result.frames.empty()) return result;
  const auto tracked = static_cast<double>(result.frames.size());
  result.first_tracked_frame = result.frames.front().truth;
  result.tracked_share = tracked / (result.truth_frames - result.first_tracked_frame);
  result.head_found_share = heads_found / tracked;
  result.distance_mm = SummarizeDistances(std::move(distances));
  result.spread_mm = Spread(result.frames, truth, output);
  result.point_mm /= tracked;
  result.angle_rad /= tracked;
  result.mean_angle_rad = result.angle_rad.mean();
  return result;
}

}  // namespace mocap
