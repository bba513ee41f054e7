// The recorded files of one camera, held against its calibration.
#pragma once

#include <filesystem>

#include "core/reconstruction/camera/camera_model.h"
#include "drivers/background_source.h"
#include "drivers/take/take_table.h"
#include "drivers/take/video_reader.h"

namespace mocap {

/// Opens a video. @throws SetupError  also when its pictures have another size than the camera's.
VideoReader OpenCameraVideo(const std::filesystem::path& file, const CameraCalibration& camera);

/// Reads a table. @throws SetupError  also when a head has no angles, or the other way round.
TakeTable ReadCameraTable(const std::filesystem::path& file, const CameraCalibration& camera);

/// Makes sure that a camera's pictures of the empty studio are there; reads them when asked, one by
/// one, in any thread.
/// @param table  of its angles; looked at for a camera on a head only.
/// @throws SetupError  naming the file.
BackgroundSource OpenCameraBackground(const std::filesystem::path& video,
                                      const std::filesystem::path& table,
                                      const CameraCalibration& camera);

/// Makes an empty folder beside that of the empty studio, in which the next one is written.
/// @param folder  may end with a slash, and may be a link.
/// @throws SetupError  when there is something else than pictures in either, which would be taken
/// away, or it cannot be made.
std::filesystem::path BeginBackground(const std::filesystem::path& folder);

/// Puts what BeginBackground made in the folder's place in one step, and takes the old one away.
/// @throws SetupError, std::runtime_error  when that cannot be.
void ReplaceBackground(const std::filesystem::path& folder, const std::filesystem::path& with);

}  // namespace mocap
