// Tells from silhouettes of a moving person whether cameras still stand where they were calibrated,
// and puts small motions right.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "tools/take_samples.h"

namespace mocap {

/// How far one camera's pictures lie from where the other cameras' hull puts the person.
struct CameraShift {
  std::string camera;
  Vector2 shift_px = Vector2::Zero();  ///< To the right and down: seen minus expected.
  double spread_px = 0;                ///< Of single moments about it.
  double overlap = 0;                  ///< Mean intersection over union at the best shift.
  int moments = 0;                     ///< That could be compared.
  Vector3 rotation_C =
      Vector3::Zero();  ///< Turn of the camera that explains it [rad], in its frame.
  double growth = 0;    ///< Of its picture since it was calibrated, as a share: focus or zoom.
};

/// A shift as large as this is no accident of silhouettes [px].
inline constexpr double kMovedPx = 1.5;
/// Nor is so large a growth of the picture.
inline constexpr double kZoomedShare = 0.015;

/// Chooses moments spread evenly over a take, or over its part from `from_s` to `to_s`.
std::vector<SampleRequest> ChooseHealthMoments(const std::filesystem::path& take, double from_s,
                                               double to_s, int count);

/// Compares each camera with the hull that the others carve.
///
/// @param cameras  whose poses are tried, in the order of the samples; lenses as in the samples.
std::vector<CameraShift> MeasureShifts(const TakeSamples& samples,
                                       const std::vector<CameraCalibration>& cameras);

/// Where the carved person begins and ends above the floor, the median over moments [mm].
struct StandingPerson {
  int moments = 0;
  double lowest_mm = 0, highest_mm = 0;
};

StandingPerson MeasurePerson(const TakeSamples& samples);

/// Outcome of refining.
struct RefinedStudio {
  std::vector<CameraCalibration> cameras;
  std::vector<CameraShift> before, after;
  std::vector<std::string> moved;  ///< Names, in the order in which they were found.
};

/// Turns the cameras that moved, the worst first, until all agree with each other. Only turns are
/// corrected, which a bump is for the most part.
/// @throws SetupError  when fewer than three cameras see the person or more than half have moved.
RefinedStudio RefineFromSilhouettes(const TakeSamples& samples);

}  // namespace mocap
