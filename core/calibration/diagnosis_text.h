// What a diagnosis of the cameras' silhouettes means to whoever calibrated them.
#pragma once

#include <optional>
#include <span>

#include "core/calibration/finding.h"
#include "core/calibration/studio_diagnosis.h"

namespace mocap {

/// Describes the fault and its remedy; empty if there is none.
std::optional<Finding> FindingOf(const StudioDiagnosis& diagnosis,
                                 std::span<const CameraCalibration> cameras);

}  // namespace mocap
