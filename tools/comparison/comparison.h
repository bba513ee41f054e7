// A result beside another recording of the same motion: the figures of a validation.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/comparison/agreement.h"
#include "tools/comparison/alignment.h"

namespace mocap {

/// A point in both recordings, at shared moments.
struct PointComparison {
  std::string point = {};
  std::vector<std::string> others = {};
  std::vector<Vector3> own_W = {}, other_W = {};  ///< NaN: not seen [mm].
  /// Of ours less the other's along the axes of the body segment: ahead, left, up [mm].
  std::array<Agreement, 3> axes = {};
  Agreement distance = {};       ///< Of the lengths of the differences.
  double rmsd_without_bias = 0;  ///< Of differences less their mean in the segment's axes [mm].
  double speed_correlation = 0;  ///< Pearson's, of the speeds.
};

/// An angle in both recordings.
struct AngleComparison {
  std::string angle, other;
  std::vector<double> own_deg, other_deg;
  Agreement agreement;
  double correlation = 0;           ///< Pearson's.
  double multiple_correlation = 0;  ///< Ferrari et al. 2010.
};

struct Comparison {
  std::string person, subject;  ///< Of results and files of several; else empty.
  std::string format;
  double other_rate_hz = 0, other_seconds = 0;
  std::size_t other_frames = 0;
  Alignment alignment;
  std::vector<double> time_s;  ///< Shared moments, of the result.
  std::vector<PointComparison> points;
  std::vector<AngleComparison> angles;
  bool angles_by_points = false;  ///< Of three points each, in both recordings alike.
  double points_rmsd_mm = 0, points_rmsd_without_bias_mm = 0, points_mean_mm = 0;
  double angles_rmsd_deg = 0, angles_rmsd_without_bias_deg = 0;  ///< NaN: no angle.
  std::vector<std::string> not_compared;                         ///< Markers without a point.
  std::vector<std::string> remarks;
};

struct ComparisonRequest {
  std::filesystem::path result, other;
  std::optional<std::string> prefix = {};   ///< Of a log.
  std::optional<std::string> person = {};   ///< Of a result of several; empty: whoever fits best.
  std::optional<std::string> subject = {};  ///< Of a file of several; empty: whoever fits best.
  std::filesystem::path map = {};           ///< Empty: none.
};

/// Compares a result with a C3D, TRC, BVH, mot or CSV file, a take with truth, or a second result.
/// @throws SetupError  for files that cannot be read, and recordings that do not fit.
Comparison Compare(const ComparisonRequest& request);

/// Reads any of these. @throws SetupError  naming file and line.
MotionFile ReadMotionFile(const std::filesystem::path& file,
                          const std::optional<std::string>& prefix = {});

/// Measures points and angles of aligned recordings.
/// @param angles  pairs of angle names.
void Measure(const ResultMotion& own, const RecordedMotion& other,
             const std::vector<AnglePair>& angles, Comparison& comparison);

}  // namespace mocap
