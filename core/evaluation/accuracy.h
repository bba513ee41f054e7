// §8 with ground truth: accuracy: distance of tracked points, angles and lengths from the true
// ones.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/body/body_model.h"
#include "core/body/body_part.h"
#include "core/geometry.h"

namespace mocap {

/// The points that a tracked body and a rig have in common.
inline constexpr std::array kScoredPoints = {
    Point::kHead,   Point::kNeck,        Point::kShoulderL,   Point::kShoulderR, Point::kElbowL,
    Point::kElbowR, Point::kFingertipsL, Point::kFingertipsR, Point::kHipL,      Point::kHipR,
    Point::kKneeL,  Point::kKneeR,       Point::kFootL,       Point::kFootR};
inline constexpr int kScoredPointCount = static_cast<int>(kScoredPoints.size());

/// 3 × 14; column i is p_WQ of kScoredPoints[i] [mm].
using ScoredPoints = Eigen::Matrix<double, 3, kScoredPointCount>;

/// Selects the scored points.
ScoredPoints ScoredPointsOf(const BodyPoints& points_W);

/// Angles that follow from points alone, independent of any model's axes: between upper and lower
/// limb at elbow and knee (π when straight), and from the torso's axis to upper arm and thigh.
inline constexpr std::array<std::string_view, 8> kScoredAngleNames = {
    "elbow_l", "elbow_r", "knee_l", "knee_r", "shoulder_l", "shoulder_r", "hip_l", "hip_r"};
inline constexpr int kScoredAngleCount = static_cast<int>(kScoredAngleNames.size());
using ScoredAngles = Eigen::Matrix<double, kScoredAngleCount, 1>;

/// Measures the eight angles of a pose [rad].
ScoredAngles ScoredAnglesOf(const ScoredPoints& points_W);

/// One frame of the truth or of the tracker's output.
struct ScoredFrame {
  std::int64_t timestamp_ns = 0;
  bool tracked = true;  ///< Always true for the truth.
  ScoredPoints points_W = ScoredPoints::Zero();
};

/// Errors of one tracked frame.
struct FrameError {
  int pose = 0;   ///< Index among the tracker's frames,
  int truth = 0;  ///< and of the true frame nearest in time.
  Eigen::Matrix<double, kScoredPointCount, 1> point_mm;
  ScoredAngles angle_rad;  ///< Absolute.
};

/// Summary of a set of distances [mm].
struct DistanceSummary {
  double mean = 0, median = 0, p95 = 0, worst = 0;
};

/// Summarizes distances; the order does not matter. @pre  there are some.
DistanceSummary SummarizeDistances(std::vector<double> distances_mm);

/// Results over all tracked frames that the truth covers.
struct Accuracy {
  int truth_frames = 0;
  int first_tracked_frame = -1;  ///< Index of a true frame; -1: never tracked, and all else is 0.
  double tracked_share = 0;      ///< Of the true frames from the first tracked one on.
  double head_found_share = 0;   ///< Of the tracked frames: head within kHeadFoundMm.
  DistanceSummary distance_mm;   ///< Over all points and frames; the mean is the MPJPE.
  /// Mean after subtracting each point's own mean offset, in a frame that turns with its bone. It
  /// excludes errors that come from a different definition of the joints in the rig.
  double spread_mm = 0;
  Eigen::Matrix<double, kScoredPointCount, 1> point_mm;  ///< Mean per point.
  ScoredAngles angle_rad;                                ///< Mean absolute error of each angle.
  double mean_angle_rad = 0;
  std::vector<FrameError> frames;
};

/// A head that is closer than this to its true position counts as found.
inline constexpr double kHeadFoundMm = 60;

/// Compares the tracker's output with the truth. Each output frame is matched with the true frame
/// nearest in time, at most half a period away. A true frame is used once.
///
/// @param truth  in temporal order, not empty.
Accuracy MeasureAccuracy(std::span<const ScoredFrame> truth, std::span<const ScoredFrame> output);

}  // namespace mocap
