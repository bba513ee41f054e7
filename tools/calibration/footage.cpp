#include "tools/calibration/footage.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "core/errors.h"
#include "drivers/lowered.h"
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/take_table.h"
#include "drivers/take/video_reader.h"
#include "tools/calibration/picture_files.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

bool IsVideo(const fs::path& file) {
  const std::string e = Lowered(file.extension().string());
  return e == ".mkv" || e == ".mp4" || e == ".avi" || e == ".mov" || e == ".m4v" || e == ".webm";
}

// Lists frames, with the file's times if they exist and increase.
void CountFrames(VideoReader video, FootageCamera& camera) {
  bool has_times = true;
  std::optional<std::int64_t> first_ns;
  std::vector<std::int64_t> times_ns;
  for (int i = 0; video.Skip() != VideoStatus::kEnd; ++i) {
    camera.frames.push_back({i * kUntimedInterval_ns, {}, "frame " + std::to_string(i), ""});
    const std::optional<std::int64_t> time_ns = video.time_ns();
    if (!first_ns) first_ns = time_ns;
    has_times =
        has_times && time_ns && (times_ns.empty() || *time_ns - *first_ns > times_ns.back());
    if (has_times) times_ns.push_back(*time_ns - *first_ns);
  }
  camera.placed = has_times;
  if (!has_times) return;
  for (std::size_t i = 0; i < times_ns.size(); ++i) camera.frames[i].time_ns = times_ns[i];
}

// Reports how a file was interpreted.
void TellHowItWasRead(const fs::path& file, const PictureTurn& turn, const FootageCamera& camera,
                      std::vector<std::string>& notes) {
  const std::string name = Printable(file.filename().string());
  if (!turn.IsNone()) notes.push_back(name + ": " + turn.Text() + ", as the file says");
  if (camera.timed || !camera.placed || camera.frames.size() < 3) return;
  std::int64_t shortest_ns = std::numeric_limits<std::int64_t>::max(), longest_ns = 0;
  for (std::size_t i = 1; i < camera.frames.size(); ++i) {
    const std::int64_t step_ns = camera.frames[i].time_ns - camera.frames[i - 1].time_ns;
    shortest_ns = std::min(shortest_ns, step_ns);
    longest_ns = std::max(longest_ns, step_ns);
  }
  if (2 * longest_ns > 3 * shortest_ns)
    notes.push_back(name + ": its frames lie " + std::to_string(shortest_ns / 1'000'000) + " to " +
                    std::to_string(longest_ns / 1'000'000) +
                    " ms apart; they are paired with others' by these times");
}

fs::path TableOf(const fs::path& video) { return fs::path(video).replace_extension(".csv"); }

/// Whether a camera had delivered nothing by the end of the recording.
bool IsSilent(const fs::path& video) { return HoldsNoRows(TableOf(video)) || HoldsNoFrame(video); }

FootageCamera OpenVideoCamera(const std::string& name, const fs::path& file,
                              std::vector<std::string>& notes) {
  FootageCamera camera;
  camera.name = name;
  VideoReader video(file);
  const PictureTurn turn = video.turn();
  camera.width_px = video.width_px();
  camera.height_px = video.height_px();
  CountFrames(std::move(video), camera);
  const fs::path table_file = TableOf(file);
  if (IsThere(table_file)) {
    const TakeTable table = ReadTakeTable(table_file);
    camera.timed = true;
    // In a truncated recording, the end of either may be missing.
    camera.frames.resize(std::min(camera.frames.size(), table.rows.size()));
    for (std::size_t i = 0; i < camera.frames.size(); ++i)
      camera.frames[i] = {table.rows[i].timestamp_ns, table.rows[i].angles,
                          "frame " + std::to_string(table.rows[i].frame), ""};
  }
  TellHowItWasRead(file, turn, camera, notes);
  camera.ForEach = [file, count = static_cast<int>(camera.frames.size())](const auto& use) {
    VideoReader reader(file);
    ImageView<const Bgr> view;
    for (int i = 0; i < count; ++i) {
      const VideoStatus status = reader.Read(view);
      if (status == VideoStatus::kEnd) break;
      if (status == VideoStatus::kFrame) use(i, view);
    }
  };
  return camera;
}

// For FFmpeg, a picture is a video of one frame.
VideoReader OpenPicture(const fs::path& file) {
  try {
    return VideoReader(file);
  } catch (const SetupError&) {
    RefuseUnreadPicture(file);
  }
}

FootageCamera OpenPictureCamera(const std::string& name, const std::vector<fs::path>& unsorted,
                                std::vector<std::string>& notes) {
  FootageCamera camera;
  camera.name = name;
  const std::vector<std::string> keys = PictureKeys(unsorted);
  std::vector<std::size_t> order(keys.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return IsKeyLess(keys[a], keys[b]); });
  std::vector<fs::path> files;
  for (const std::size_t i : order) {
    camera.frames.push_back({static_cast<std::int64_t>(files.size()) * kUntimedInterval_ns,
                             {},
                             unsorted[i].filename().string(),
                             keys[i]});
    files.push_back(unsorted[i]);
  }
  const VideoReader first = OpenPicture(files.front());
  camera.width_px = first.width_px();
  camera.height_px = first.height_px();
  if (!first.turn().IsNone())
    notes.push_back(name + ": its pictures are " + first.turn().Text() +
                    ", as their metadata says");
  camera.ForEach = [files, width_px = camera.width_px,
                    height_px = camera.height_px](const auto& use) {
    for (std::size_t i = 0; i < files.size(); ++i) {
      VideoReader picture = OpenPicture(files[i]);
      if (picture.width_px() != width_px || picture.height_px() != height_px)
        throw SetupError(files[i].string() + ": is " + std::to_string(picture.width_px()) + " x " +
                         std::to_string(picture.height_px()) + "; the pictures before it are " +
                         std::to_string(width_px) + " x " + std::to_string(height_px) +
                         "; expected all pictures of a camera in one resolution");
      ImageView<const Bgr> pixels;
      picture.Read(pixels);
      use(static_cast<int>(i), pixels);
    }
  };
  return camera;
}

// A folder without a video may be a camera's whose pictures are not read, unless cameras have
// videos.
void OpenFoldersOfCameras(Footage& footage) {
  std::vector<fs::path> others;
  bool has_videos = false;
  for (const fs::path& inside : Listed(footage.folder, IsFolder)) {
    const std::string name = inside.filename().string();
    const std::vector<fs::path> videos = Listed(inside, IsVideo);
    const std::vector<fs::path> pictures = Listed(inside, IsPicture);
    if (videos.size() == 1) {
      footage.cameras.push_back(OpenVideoCamera(name, videos[0], footage.notes));
      has_videos = true;
    } else if (videos.empty() && pictures.empty()) {
      others.push_back(inside);
    } else if (videos.empty()) {
      RefuseUnreadPictures(inside);
      footage.cameras.push_back(OpenPictureCamera(name, pictures, footage.notes));
    }
  }
  if (has_videos) return;
  for (const fs::path& other : others) RefuseUnreadPictures(other);
}

}  // namespace

Footage OpenFootage(const std::filesystem::path& folder) {
  RequireFolder(folder, "a take or a folder of recordings");
  Footage footage;
  footage.folder = folder;
  const std::vector<fs::path> recorded = Listed(folder, IsVideo);
  for (const fs::path& file : recorded) {
    if (!IsSilent(file))
      footage.cameras.push_back(OpenVideoCamera(file.stem().string(), file, footage.notes));
  }
  if (footage.cameras.empty() && !recorded.empty())
    throw SetupError(folder.string() +
                     ": contains no frame of any camera; expected recordings with frames");
  // Caliscope's name, now and formerly.
  for (const char* table : {"timestamps.csv", "frame_time_history.csv"}) {
    if (footage.cameras.empty() || !IsThere(folder / table)) continue;
    ReadSharedTimes(folder / table, footage);
    break;
  }
  if (footage.cameras.empty()) OpenFoldersOfCameras(footage);
  if (footage.cameras.empty()) {
    RefuseUnreadPictures(folder);
    const std::vector<fs::path> pictures = Listed(folder, IsPicture);
    if (!pictures.empty())
      footage.cameras.push_back(
          OpenPictureCamera(folder.filename().string(), pictures, footage.notes));
  }
  if (footage.cameras.empty())
    throw SetupError(folder.string() + ": contains no recording" + WhatIsThere(folder) +
                     "; expected cam1.mkv, cam2.mkv ... or a folder of pictures (PNG, JPEG, TIFF, "
                     "BMP or WebP) for each camera");
  for (const FootageCamera& camera : footage.cameras) {
    if (!IsCameraName(camera.name))
      throw SetupError(
          folder.string() + ": " + Quoted(camera.name) +
          ": a recording's name is that of its camera; expected letters, digits, _ and -");
  }
  PairPictures(footage);
  return footage;
}

}  // namespace mocap
