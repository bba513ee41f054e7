// One simulated take, tracked live and solved, side by side.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "tools/accuracy/accuracy_benchmark.h"

namespace mocap {

/// How well a person was tracked live, and how well the same sets were solved.
struct SolveRow {
  struct Side {
    AccuracyRow accuracy;
    double jitter_mm = 0;
    double within_two_deviations = 0;  ///< Share of the errors.
  };
  Side live, solved;
  double true_jitter_mm = 0;
};

/// Uses all processors.
/// @throws std::runtime_error  when the folder for temporary files cannot be written.
SolveRow RunSolveTrial(const AccuracyTrial& trial);

/// Header of SolveLine's columns.
std::string SolveHeader();
std::string SolveLine(const SolveRow& row);
/// Means, wrong people, and who got worse by more than 5 mm.
std::string SolveTable(std::span<const SolveRow> rows);

}  // namespace mocap
