// Calibration files: cameras, and data about the calibration.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Largest width and height of a picture.
inline constexpr int kLargestPicture_px = 16384;

/// Offset of a camera's silhouettes from the other cameras' reconstruction.
struct CameraOffset {
  std::string camera;
  double px = 0;
  bool has_moved = false;  ///< More than silhouette errors explain.
};

/// Data about a calibration, in its own file. Files of other programs and of takes may lack it.
struct CalibrationRecord {
  std::int64_t made_s = 0;            ///< Since the Unix epoch; 0: not known.
  double reprojection_px = 0;         ///< 0: not known.
  std::int64_t refined_s = 0;         ///< When moved cameras were last corrected; 0: never.
  std::int64_t checked_s = 0;         ///< When it was last checked; 0: never.
  std::vector<CameraOffset> offsets;  ///< Result of that check.
};

/// Names of the cameras, in their order.
std::vector<std::string> CameraNames(std::span<const CameraCalibration> cameras);

/// Formats calibration.toml, with every digit of each number, so that reading restores it.
/// @param file  its name in messages.
/// @throws SetupError  naming the camera and the fault: a number that is not finite, an invalid or
/// duplicate name, an invalid rotation.
std::string CalibrationText(const std::filesystem::path& file,
                            std::span<const CameraCalibration> cameras,
                            const CalibrationRecord& record = {});

/// Writes calibration.toml.
/// @throws SetupError  as CalibrationText; std::runtime_error  when the file cannot be written.
void WriteCalibration(const std::filesystem::path& file, std::span<const CameraCalibration> cameras,
                      const CalibrationRecord& record = {});

}  // namespace mocap
