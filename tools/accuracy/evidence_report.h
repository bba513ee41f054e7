// Accuracy on weak evidence, as text, as a Markdown table and as a plot.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/accuracy/evidence_trial.h"

namespace mocap {

/// All takes of one kind.
struct EvidenceSummary {
  EvidenceKind kind;
  AccuracySummary accuracy;
  double hull_share = 0;     ///< The mean.
  double unknown_share = 0;  ///< Likewise.

  bool is_tracked() const { return accuracy.tracked_share > 0; }
  /// Infinite if nobody is tracked.
  double error_mm() const {
    return is_tracked() ? accuracy.mpjpe_mm : std::numeric_limits<double>::infinity();
  }
};

/// An error that rises by more, when cameras are added, is a fault.
inline constexpr double kMostRise_mm = 1;

/// Summarizes the takes of each kind, in the order of their first takes.
std::vector<EvidenceSummary> SummarizeEvidence(std::span<const EvidenceRow> rows);

/// An error that is larger with more cameras.
struct EvidenceRise {
  EvidenceKind fewer, more;
  double fewer_mm = 0, more_mm = 0;

  double mm() const { return more_mm - fewer_mm; }
};

/// Finds the largest difference between two kinds that differ in the number of cameras; negative if
/// every camera helps. Nothing without two such kinds of which the one with fewer cameras tracks.
std::optional<EvidenceRise> LargestRise(std::span<const EvidenceSummary> kinds);

/// Header of EvidenceLine's columns.
std::string EvidenceHeader();
std::string EvidenceLine(const EvidenceRow& row);

/// A Markdown table, with a line for each contrast and crf, and the largest rise; nothing without
/// rows.
std::string EvidenceTable(std::span<const EvidenceRow> rows);
/// The same as a chapter of a page. It links to evidence.html, which lies beside it.
std::string EvidenceMarkdown(std::span<const EvidenceRow> rows, double seconds);
/// Plots the errors over the number of cameras, as a page: a plot for each crf and a line for
/// each contrast. Crosses mark those that are larger than with fewer cameras, by kMostRise_mm.
std::string EvidenceHtml(std::span<const EvidenceRow> rows);

}  // namespace mocap
