// §4: whether calibrated cameras can stand where their calibration says, without pictures.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

enum class Severity { kNote, kWarning, kWrong };

/// One finding, as a line with the remedy.
struct Finding {
  Severity severity = Severity::kNote;
  std::string text;
};

/// Checks rotations, heights above the floor and distances between the cameras.
/// @param has_floor  whether z = 0 is meant to be the floor.
/// @return  the worst first; empty if nothing is wrong.
std::vector<Finding> CheckPlaces(std::span<const CameraCalibration> cameras, bool has_floor);

}  // namespace mocap
