// Checks of a studio's calibration beyond reprojection: is the geometry plausible?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/calibration/camera_places.h"
#include "tools/calibration/extrinsics.h"

namespace mocap {

/// Where a person stands: the point that all cameras face, at hip height if the floor is known.
Vector3 MiddleOfRoom(const std::vector<CameraCalibration>& cameras);

/// Millimetres per pixel at the middle of the room.
double MillimetresPerPixel(const CameraCalibration& camera, const Vector3& middle_W);

/// Checks cameras as read from a file: heights above the floor, positions, lenses.
std::vector<Finding> CheckCameras(const std::vector<CameraCalibration>& cameras, bool has_floor);

/// Checks a fit: errors, coverage, boards below the floor, and everything of CheckCameras.
std::vector<Finding> CheckFit(const StudioFit& fit);

std::ptrdiff_t CountOf(Severity severity, const std::vector<Finding>& findings);

/// "error", "warning" or "note".
const char* NameOf(Severity severity);

/// Summarizes findings in a sentence.
std::string Conclusion(const std::vector<Finding>& findings);

/// A distance between two cameras' lenses, measured by tape.
struct KnownDistance {
  std::string from, to;
  double mm = 0;
};

/// Parses `cam1:cam2:MM`. @throws SetupError
KnownDistance ParseDistance(const std::string& text);

/// The distance by the calibration. @throws SetupError  when there is no such camera.
double DistanceMm(const KnownDistance& distance, const std::vector<CameraCalibration>& cameras);

/// Part of the room that cameras see.
struct SeenVolume {
  double cell_mm = 100;
  Vector3 low_W, high_W;
  /// Volume [m³] seen by at least n cameras, at [n].
  std::vector<double> cubic_m;
  /// Number of cameras that see each cell at 1 m above the floor; rows in the direction of y.
  int columns = 0, rows = 0;
  std::vector<int> plan;
};

/// Measures over a box of 8 m around the middle of the room, up to 2.2 m.
SeenVolume MeasureSeenVolume(const std::vector<CameraCalibration>& cameras);

}  // namespace mocap
