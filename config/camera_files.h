// Opens one camera's recorded files, and checks them against its calibration.
#pragma once

#include <filesystem>

#include "core/reconstruction/camera/camera_model.h"
#include "drivers/background_source.h"
#include "drivers/take/take_table.h"
#include "drivers/take/video_reader.h"

namespace mocap {

/// Opens a video. @throws SetupError  also if its picture size differs from the camera's.
VideoReader OpenCameraVideo(const std::filesystem::path& file, const CameraCalibration& camera);

/// Reads a table. @throws SetupError  also if a pan-tilt head has no angles, or vice versa.
TakeTable ReadCameraTable(const std::filesystem::path& file, const CameraCalibration& camera);

/// Checks that a camera's background pictures exist, and what is known of them (UnseenBeside). The
/// source reads them on demand, one by one,
/// in any thread.
/// @param table  of angles; used only for a camera on a pan-tilt head.
/// @throws SetupError  naming the file.
BackgroundSource OpenCameraBackground(const std::filesystem::path& video,
                                      const std::filesystem::path& table,
                                      const CameraCalibration& camera);

/// Creates an empty folder beside the background's folder, for the next background.
/// @param folder  may end with a slash, and may be a link.
/// @throws SetupError  if either contains anything but pictures, which would be deleted, or it
/// cannot be created.
std::filesystem::path BeginBackground(const std::filesystem::path& folder);

/// Replaces the folder by the one from BeginBackground in one step, and deletes the old one.
/// @throws SetupError, std::runtime_error  if that fails.
void ReplaceBackground(const std::filesystem::path& folder, const std::filesystem::path& with);

}  // namespace mocap
