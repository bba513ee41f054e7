// What the accuracy benchmark varies, one thing at a time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/accuracy/accuracy_trial.h"

namespace mocap {

/// One value of what is varied.
struct SweepStep {
  std::string label;
  std::function<void(AccuracyTrial&)> change;
};

struct SweepPlan {
  std::string part;  ///< Of the benchmark.
  std::string what;  ///< With unit.
  std::vector<SweepStep> steps;
};

/// Returns what makes tracking worse: fewer cameras, coarser voxels, bad pictures.
std::vector<SweepPlan> PlannedSweeps();

/// Returns the usual studio, and those that differ from it as their labels say: in number, place,
/// height, resolution or frame rate of the cameras.
SweepPlan PlannedStudios();

}  // namespace mocap
