#include "config/camera_files.h"

#include <fcntl.h>
#include <stdio.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/errors.h"

namespace mocap {
namespace {

// Enough for the statistics of a still picture; an hour of it would not fit into memory. A head
// needs all it has.
constexpr std::size_t kMostStillFrames = 200;

void ReadBackground(const std::filesystem::path& file, const CameraCalibration& camera,
                    const std::vector<TakeRow>& rows, const BackgroundSource::Visit& visit) {
  VideoReader video = OpenCameraVideo(file, camera);
  BackgroundFrame frame{Image<Bgr>(camera.width_px, camera.height_px), {}};
  ImageView<const Bgr> view;
  const std::size_t most = camera.head ? rows.size() : kMostStillFrames;
  for (std::size_t i = 0; i < most; ++i) {
    const VideoStatus status = video.Read(view);
    if (status == VideoStatus::kEnd) break;
    if (status == VideoStatus::kBroken) continue;
    for (int y = 0; y < view.height(); ++y) {
      std::copy_n(view.row(y), view.width(), frame.image.row(y));
    }
    if (camera.head) frame.angles = rows[i].angles;
    visit(frame);
  }
}

}  // namespace

VideoReader OpenCameraVideo(const std::filesystem::path& file, const CameraCalibration& camera) {
  VideoReader video(file);
  if (video.width_px() != camera.width_px || video.height_px() != camera.height_px) {
    const auto size = [](int width, int height) {
      return std::to_string(width) + " x " + std::to_string(height);
    };
    throw SetupError(file.string() + ": has pictures of " +
                     size(video.width_px(), video.height_px()) + "; " + camera.name +
                     " is calibrated for " + size(camera.width_px, camera.height_px));
  }
  return video;
}

// Angles and a head belong together: one without the other would be wrong in silence.
TakeTable ReadCameraTable(const std::filesystem::path& file, const CameraCalibration& camera) {
  TakeTable table = ReadTakeTable(file);
  if (camera.head && !table.has_angles) {
    throw SetupError(file.string() + ":1: has no pan_rad,tilt_rad, but calibration.toml has " +
                     "cameras." + camera.name + ".pan_tilt");
  }
  const bool turns = std::any_of(table.rows.begin(), table.rows.end(),
                                 [](const TakeRow& row) { return row.angles != PanTiltAngles{}; });
  if (!camera.head && turns) {
    throw SetupError(file.string() + ": has pan and tilt, but calibration.toml has no cameras." +
                     camera.name + ".pan_tilt");
  }
  return table;
}

BackgroundSource OpenCameraBackground(const std::filesystem::path& video,
                                      const std::filesystem::path& table,
                                      const CameraCalibration& camera) {
  OpenCameraVideo(video, camera);
  std::vector<TakeRow> rows;
  if (camera.head) rows = ReadCameraTable(table, camera).rows;
  return BackgroundSource::OneByOne(
      [video, camera, rows = std::move(rows)](const BackgroundSource::Visit& visit) {
        ReadBackground(video, camera, rows, visit);
      });
}

void ReplaceFolder(const std::filesystem::path& folder, const std::filesystem::path& with) {
  if (!std::filesystem::exists(folder)) return std::filesystem::rename(with, folder);
  if (renameat2(AT_FDCWD, with.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) != 0) {
    throw std::runtime_error(folder.string() + ": cannot be replaced: " + std::strerror(errno));
  }
  std::filesystem::remove_all(with);
}

}  // namespace mocap
