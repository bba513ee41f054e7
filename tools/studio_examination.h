// What a take's silhouettes say about a calibration.
#pragma once

#include <optional>
#include <vector>

#include "core/calibration/finding.h"
#include "core/calibration/studio_diagnosis.h"
#include "tools/take_samples.h"

namespace mocap {

/// What all cameras show at the sampled moments, by poses of another calibration.
/// @param cameras  in the order of the samples' cameras.
std::vector<SeenMoment> MomentsOf(const TakeSamples& samples,
                                  const std::vector<CameraCalibration>& cameras);
/// By the take's own calibration.
inline std::vector<SeenMoment> MomentsOf(const TakeSamples& samples) {
  return MomentsOf(samples, samples.cameras);
}

/// Finds what is wrong with the cameras of a take that is tracked; empty if nothing is.
std::optional<Finding> ExamineStudio(const TakeSamples& samples);

}  // namespace mocap
