// Accuracy of what a body has beyond the paper's: hands, feet, the turn of the head, and contact.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/evaluation/accuracy.h"
#include "tools/results/result.h"
#include "tools/results/take_truth.h"

namespace mocap {

/// Absolute errors of one figure.
struct FigureErrors {
  std::string name;
  double mean = 0, p95 = 0;
};

/// Frames in which a part of a foot stands, or seems to.
struct ContactScore {
  int hits = 0, false_alarms = 0, misses = 0;

  bool IsEmpty() const { return hits + false_alarms + misses == 0; }
  /// 0 to 1. Harmonic mean of precision and recall; 1 if nothing was wrong.
  double F1() const;
  double Precision() const;
  double Recall() const;
};

/// How far a point of a foot moves along the floor while it stands [mm].
struct Skating {
  int stances = 0;
  double frame_p95_mm = 0;                       ///< From one frame to the next.
  double stance_mean_mm = 0, stance_p95_mm = 0;  ///< Farthest from where the stance began.
};

/// Parts of a foot that touch the floor.
inline constexpr std::array<std::string_view, 2> kFootPartNames = {"heel", "toe"};

/// Figures are left out where truth or result do not have them, such as those of the hands of a
/// body without hands, and of a head that cannot turn about its length.
struct ExtremityAccuracy {
  std::vector<FigureErrors> points_mm;
  /// ankle_flexion_l and _r: angle between shank and sole; of a truth without heels, less the mean
  /// error, because its toes may lie anywhere in the foot. head_yaw, head_pitch, head_roll:
  /// components of the error's rotation vector about the true head's axes z, y and x.
  /// hand_direction_l and _r: between the directions of the fingers; hand_turn_l and _r: about it.
  std::vector<FigureErrors> angles_deg;
  // By kFootPartNames, of both feet:
  std::array<ContactScore, 2> contacts;
  /// Of true stances: the published points, and the true ones, which also roll.
  std::array<Skating, 2> skating, true_skating;

  bool IsEmpty() const { return points_mm.empty() && angles_deg.empty(); }
};

/// A contact counts as right if it holds true at most this long before or after [s]: a frame at
/// 30 Hz. True contacts begin and end halfway between two frames.
inline constexpr double kContactTolerance_s = 0.033;

/// Measures a result in frames that have truth. Angles of head and hands follow from its segments:
/// see SegmentPoser.
/// @param frames  in order of time.
ExtremityAccuracy MeasureExtremities(const Result& result, const TakeTruth& truth,
                                     std::span<const FrameError> frames);

/// Averages each figure over the takes that have it; contacts are counted together.
ExtremityAccuracy MeanOf(std::span<const ExtremityAccuracy> takes);

}  // namespace mocap
