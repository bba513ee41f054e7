// Calibration on disk: cameras, and what is known of how they were calibrated.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Pictures are no wider and no higher.
inline constexpr int kLargestPicture_px = 16384;

/// How far a camera's pictures lie from where the others put the person.
struct CameraOffset {
  std::string camera;
  double px = 0;
  bool has_moved = false;  ///< More than accidents of silhouettes explain.
};

/// What a calibration says of itself. A file of another program, or a take's, may say nothing.
struct CalibrationRecord {
  std::int64_t made_s = 0;            ///< Since the Unix epoch; 0: not known.
  double reprojection_px = 0;         ///< 0: not known.
  std::int64_t refined_s = 0;         ///< When cameras that moved were put right; 0: never.
  std::int64_t checked_s = 0;         ///< When its health was looked at last; 0: never.
  std::vector<CameraOffset> offsets;  ///< What that look found.
};

/// Makes the text of calibration.toml, every number with all its digits. What is written can be
/// read again.
/// @param file  what messages call it.
/// @throws SetupError  naming the camera and what is wrong, where that cannot be: a number that is
/// not finite, a name that is none or another camera's too, a rotation that is none.
std::string CalibrationText(const std::filesystem::path& file,
                            std::span<const CameraCalibration> cameras,
                            const CalibrationRecord& record = {});

/// Writes calibration.toml.
/// @throws SetupError  as CalibrationText; std::runtime_error  when the file cannot be written.
void WriteCalibration(const std::filesystem::path& file, std::span<const CameraCalibration> cameras,
                      const CalibrationRecord& record = {});

}  // namespace mocap
