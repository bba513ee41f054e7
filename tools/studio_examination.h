// What a take's silhouettes say about a calibration.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/calibration/camera_places.h"
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

/// Finds what keeps the take from being tracked with its own calibration; empty if nothing does.
std::optional<Finding> ExamineStudio(const TakeSamples& samples);

/// Prints remarks about a command's input, one line each, to standard error.
void TellRemarks(const std::string& command, const std::vector<std::string>& remarks);

}  // namespace mocap
