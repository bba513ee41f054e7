// Truth of a take: joint positions and lengths of the parts.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/evaluation/accuracy.h"
#include "core/motion_capture.h"
#include "drivers/take/truth_columns.h"

namespace mocap {

/// Rotation vectors of kTurnedSegmentNames [rad].
using SegmentTurns = Eigen::Matrix<double, 3, kTurnedSegmentNames.size()>;

/// What is true of hands, feet and head in a frame; NaN: the table does not tell.
struct TrueExtremities {
  FurtherPoints points_W = FurtherPoints::Constant(std::numeric_limits<double>::quiet_NaN());
  /// Whether heels and forefeet are on the floor: 0 or 1.
  Contacts contacts = Contacts::Constant(std::numeric_limits<double>::quiet_NaN());
  /// Each takes axes that are x forward, y to the left and z up while the person stands upright
  /// with hanging arms, to the world.
  SegmentTurns rotations = SegmentTurns::Constant(std::numeric_limits<double>::quiet_NaN());
};

struct TakeTruth {
  std::vector<ScoredFrame> frames;           ///< In order of time, at least one.
  std::vector<std::int64_t> numbers;         ///< Frame numbers in the take.
  std::vector<TrueExtremities> extremities;  ///< Of each frame; empty: nothing is known of them.
  double stature_mm = 0;
  std::map<std::string, double> lengths_mm;  ///< Without the unit in the name: "torso", "thigh" …

  /// Appends a frame of somebody's truth.
  void Add(const TakeTruth& other, std::size_t frame);
  void RemoveFirst(std::size_t count);
};

/// Name of the rig joint for a scored point.
std::string RigJoint(Point point);

/// Moves the feet of points read from RigJoint. A true foot is the sole under the ankle, on the
/// prolonged shank.
void ProlongShanks(double ankle_to_sole_mm, ScoredPoints& points_W);

/// Reads truth.csv and truth.toml of a take.
///
/// @return  empty when the take has no truth.csv.
/// @throws SetupError  naming file and line: no row, a missing column, text instead of a number,
/// times that do not increase, invalid lengths.
std::optional<TakeTruth> ReadTakeTruth(const std::filesystem::path& take);

/// Reads the truth of one of several people.
/// @return  empty also when the table has no row: the person never entered the room.
/// @throws SetupError  as ReadTakeTruth otherwise.
std::optional<TakeTruth> ReadTruthAmongOthers(const std::filesystem::path& folder);

}  // namespace mocap
