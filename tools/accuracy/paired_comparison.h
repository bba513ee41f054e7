// Whether one version of the tracker is better than another, by the same people.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/accuracy/score_table.h"

namespace mocap {

enum class PairedConclusion { kBetter, kWorse, kNoDifference, kTooFew };

/// A comparison over people. A person's error is the mean over the runs that both versions have.
struct PairedDifference {
  std::string label;  ///< Part and group; the part alone for all of its groups.
  int people = 0;
  double before_mm = 0, after_mm = 0;        ///< Means over people,
  double low_mm = 0, high_mm = 0;            ///< and bounds of their difference, with 95 %.
  double share_before = 0, share_after = 0;  ///< Tracked; also of people without errors.

  double difference_mm() const { return after_mm - before_mm; }
  PairedConclusion conclusion() const;
};

/// With fewer people, even a change that all of them agree on is luck in more than 5 % of cases.
inline constexpr int kFewestPeople = 6;

struct PairedComparison {
  /// For each group of a part, then for all groups of it if there are several.
  std::vector<PairedDifference> differences;
  std::vector<ScoreRow> only_before, only_after;    ///< Rows of one version alone.
  std::vector<ScoreRow> never_before, never_after;  ///< Pairs of which that one was never tracked.
};

/// Pairs rows by their keys, and resamples people: a paired bootstrap with a fixed seed. In all
/// groups of a part, a person with the same name is the same.
PairedComparison ComparePaired(std::span<const ScoreRow> before, std::span<const ScoreRow> after);

/// A table of the differences, and what could not be compared.
std::string ComparisonText(const PairedComparison& comparison);

}  // namespace mocap
