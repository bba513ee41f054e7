// Checks a studio's calibration beyond reprojection: is it a room that can be?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/calibration/extrinsics.h"

namespace mocap {

enum class Severity { kNote, kWarning, kWrong };

/// One thing that was noticed, as a line that says what to do.
struct Finding {
  Severity severity = Severity::kNote;
  std::string text;
};

/// The place where a person stands: what all cameras look at, at hip height where a floor is known.
Vector3 MiddleOfRoom(const std::vector<CameraCalibration>& cameras);

/// Millimetres that a pixel spans at the middle of the room.
double MillimetresPerPixel(const CameraCalibration& camera, const Vector3& middle_W);

/// Looks at cameras alone, as they come from a file: heights above the floor, places, lenses.
std::vector<Finding> CheckCameras(const std::vector<CameraCalibration>& cameras, bool has_floor);

/// Looks at a fit: errors, coverage, boards under the floor, and all of CheckCameras.
std::vector<Finding> CheckFit(const StudioFit& fit);

/// A verdict in a sentence.
std::string Verdict(const std::vector<Finding>& findings);

/// A length that was measured with a tape: between two cameras' lenses.
struct KnownDistance {
  std::string from, to;
  double mm = 0;
};

/// Reads `cam1:cam2:MM`. @throws SetupError
KnownDistance ParseDistance(const std::string& text);

/// What the calibration says of it. @throws SetupError  when there is no such camera.
double DistanceMm(const KnownDistance& distance, const std::vector<CameraCalibration>& cameras);

/// How much of the room cameras see.
struct SeenVolume {
  double cell_mm = 100;
  Vector3 low_W, high_W;
  /// m³ that are seen by at least n cameras, at [n].
  std::vector<double> cubic_m;
  /// Number of cameras that see each cell of the plan at 1 m above the floor; rows go up in y.
  int columns = 0, rows = 0;
  std::vector<int> plan;
};

/// Counts over a box of 8 m around the middle of the room, up to 2.2 m.
SeenVolume MeasureSeenVolume(const std::vector<CameraCalibration>& cameras);

}  // namespace mocap
