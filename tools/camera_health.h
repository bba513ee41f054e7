// Checks, from silhouettes of a moving person, whether cameras have moved since calibration.
// Corrects small motions.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "tools/take_samples.h"

namespace mocap {

/// Offset of a camera's silhouettes from the visual hull of the other cameras.
struct CameraShift {
  std::string camera;
  Vector2 shift_px = Vector2::Zero();  ///< Right and down: observed minus expected.
  double spread_px = 0;                ///< Of single moments about the shift.
  double overlap = 0;                  ///< Mean intersection over union at the best shift.
  int moments = 0;                     ///< Moments that could be compared.
  Vector3 rotation_C =
      Vector3::Zero();  ///< Rotation of the camera that explains the shift [rad], in its frame.
  double growth = 0;    ///< Growth of its picture since calibration, as a share: focus or zoom.
};

/// Silhouette errors do not explain a shift as large as this [px].
inline constexpr double kMovedPx = 1.5;
/// Nor growth of the picture as large as this.
inline constexpr double kZoomedShare = 0.015;

/// Chooses moments spread evenly over a take, or over its part from `from_s` to `to_s`.
std::vector<SampleRequest> ChooseHealthMoments(const std::filesystem::path& take, double from_s,
                                               double to_s, int count);

/// Compares each camera with the visual hull of the others.
///
/// @param cameras  whose poses are tested, in the order of the samples; with the samples'
/// intrinsics.
std::vector<CameraShift> MeasureShifts(const TakeSamples& samples,
                                       const std::vector<CameraCalibration>& cameras);

/// Result of refining.
struct RefinedStudio {
  std::vector<CameraCalibration> cameras;
  std::vector<CameraShift> before, after;
  std::vector<std::string> moved;  ///< Names, in the order of detection.
};

/// Rotates the cameras that moved, worst first, until all agree. Corrects only rotations, which are
/// the main effect of a bump.
/// @param cameras  as for MeasureShifts.
/// @throws SetupError  when fewer than three cameras see the person or more than half have moved.
RefinedStudio RefineFromSilhouettes(const TakeSamples& samples,
                                    const std::vector<CameraCalibration>& cameras);
/// By the take's own calibration.
inline RefinedStudio RefineFromSilhouettes(const TakeSamples& samples) {
  return RefineFromSilhouettes(samples, samples.cameras);
}

/// Whether the focus or zoom was touched.
bool IsZoomed(const CameraShift& shift);

/// Says of each camera that moved or was zoomed since it was calibrated, and what helps.
std::vector<std::string> ChangesOf(const RefinedStudio& refined);

}  // namespace mocap
