// How true the probabilities of poses are.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/evaluation/accuracy.h"
#include "daemon/base/json.h"
#include "tools/results/result.h"

namespace mocap {

/// A pose is right if the mean error of its points is below this. It lies between those that
/// mocap benchmark --parts noise calls right (up to 70 mm) and wrong (from 120 mm on).
inline constexpr double kRightPoseMm = 100;

/// Frames whose probabilities lie between two limits.
struct ProbabilityBin {
  double least = 0, most = 1;  ///< The upper limit belongs to the next bin, if there is one.
  int frames = 0, right = 0;
  double sum = 0;  ///< Of the probabilities.
};

/// Doubt, some doubt, none.
struct ProbabilityCheck {
  std::array<ProbabilityBin, 3> bins = {{{0, 0.5}, {0.5, 0.9}, {0.9, 1}}};

  /// Adds the frames of another person.
  void Add(const ProbabilityCheck& other);
  bool IsEmpty() const;
};

/// Counts frames with truth whose probability is known.
ProbabilityCheck CheckProbabilities(const std::vector<PoseRow>& poses, const Accuracy& accuracy);

/// A table for a terminal; empty without frames.
std::string ProbabilityTable(const ProbabilityCheck& check);
/// One object for each bin: from, to, frames; if it has any, mean_probability and right_share.
Json ProbabilityJson(const ProbabilityCheck& check);

}  // namespace mocap
