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
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"
#include "drivers/take/mask_video.h"
#include "drivers/take/take_layout.h"

namespace mocap {
namespace {

// Enough for the statistics of a static view; an hour of it would not fit into memory. A camera on
// a pan-tilt head needs all frames.
constexpr std::size_t kMostStillFrames = 200;

void ReadBackground(const std::filesystem::path& file, const CameraCalibration& camera,
                    const std::vector<TakeRow>& rows, const BackgroundSource::Visit& visit) {
  VideoReader video = OpenCameraVideo(file, camera);
  BackgroundFrame frame{Image<Bgr>(camera.width_px, camera.height_px), {}};
  if (IsThere(UnseenBeside(file))) frame.unseen = ReadMask(UnseenBeside(file));
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

/// The folder itself: links are resolved, and a trailing slash is removed.
std::filesystem::path Behind(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path target = std::filesystem::weakly_canonical(folder, error);
  return PlainFolder(error ? folder : target);
}

/// The folder will be deleted, so it must not contain anything else.
void RequirePicturesOnly(const std::filesystem::path& folder) {
  if (!IsThere(folder)) return;
  RequireFolder(folder, "a folder for pictures of the empty studio");
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::filesystem::path extension = entry->path().extension();
    const bool is_picture = extension == ".mkv" || extension == ".csv";
    if (is_picture && entry->is_regular_file(error)) continue;
    throw SetupError(
        folder.string() + ": contains " + Quoted(entry->path().filename().string()) +
        ", which is not a picture of the empty studio; expected a folder only for these pictures");
  }
  if (error) {
    throw SetupError(folder.string() + ": cannot be read: " + error.message() +
                     "; expected a folder that may be read");
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

// Angles require a pan-tilt head and vice versa: a mismatch would be wrong silently.
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
  if (const std::filesystem::path unseen = UnseenBeside(video); IsThere(unseen)) {
    if (camera.head)
      throw SetupError(unseen.string() + ": " + camera.name +
                       " is on a pan-tilt head; expected such a mask only of fixed cameras");
    OpenCameraVideo(unseen, camera);
  }
  std::vector<TakeRow> rows;
  if (camera.head) rows = ReadCameraTable(table, camera).rows;
  return BackgroundSource::OneByOne(
      [video, camera, rows = std::move(rows)](const BackgroundSource::Visit& visit) {
        ReadBackground(video, camera, rows, visit);
      });
}

std::filesystem::path BeginBackground(const std::filesystem::path& folder) {
  const std::filesystem::path target = Behind(folder);
  const std::filesystem::path partial = target.string() + ".partial";
  RequirePicturesOnly(target);
  RequirePicturesOnly(partial);
  std::error_code error;
  std::filesystem::remove_all(partial, error);
  if (!error) std::filesystem::create_directories(partial, error);
  if (!error) return partial;
  throw SetupError(partial.string() + ": cannot be created: " + error.message() +
                   "; for the service, set background = \"/var/lib/mocapd/background\"");
}

void ReplaceBackground(const std::filesystem::path& folder, const std::filesystem::path& with) {
  const std::filesystem::path target = Behind(folder);
  RequirePicturesOnly(target);
  const unsigned how = IsThere(target) ? RENAME_EXCHANGE : RENAME_NOREPLACE;
  if (renameat2(AT_FDCWD, with.c_str(), AT_FDCWD, target.c_str(), how) != 0) {
    throw std::runtime_error(target.string() + ": cannot be replaced: " + std::strerror(errno) +
                             "; expected a folder that may be renamed");
  }
  std::error_code error;
  if (how == RENAME_EXCHANGE) std::filesystem::remove_all(with, error);
}

}  // namespace mocap
