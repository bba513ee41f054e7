#include "tools/calibration/footage.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <memory>

#include "core/errors.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/take_table.h"
#include "drivers/take/video_reader.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

// Without times, frames lie a second apart: only their order counts.
constexpr std::int64_t kUntimedInterval_ns = 1'000'000'000;

std::string Extension(const fs::path& file) {
  std::string text = file.extension().string();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool IsVideo(const fs::path& file) {
  const std::string e = Extension(file);
  return e == ".mkv" || e == ".mp4" || e == ".avi" || e == ".mov" || e == ".webm";
}

bool IsPicture(const fs::path& file) {
  const std::string e = Extension(file);
  return e == ".png" || e == ".jpg" || e == ".jpeg" || e == ".tif" || e == ".tiff" || e == ".bmp";
}

std::vector<fs::path> Sorted(const fs::path& folder, bool (*wanted)(const fs::path&)) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (wanted(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void CountFrames(VideoReader video, FootageCamera& camera) {
  for (int i = 0; video.Skip() != VideoStatus::kEnd; ++i)
    camera.frames.push_back({i * kUntimedInterval_ns, {}, "frame " + std::to_string(i)});
}

fs::path TableOf(const fs::path& video) { return fs::path(video).replace_extension(".csv"); }

/// A camera that had delivered nothing by the end of the recording.
bool IsSilent(const fs::path& video) { return HoldsNoRows(TableOf(video)) || HoldsNoFrame(video); }

FootageCamera OpenVideoCamera(const std::string& name, const fs::path& file) {
  FootageCamera camera;
  camera.name = name;
  VideoReader video(file);
  camera.width_px = video.width_px();
  camera.height_px = video.height_px();
  CountFrames(std::move(video), camera);
  const fs::path table_file = TableOf(file);
  if (fs::exists(table_file)) {
    const TakeTable table = ReadTakeTable(table_file);
    camera.timed = true;
    // A recording that was cut off may have lost the end of either.
    camera.frames.resize(std::min(camera.frames.size(), table.rows.size()));
    for (std::size_t i = 0; i < camera.frames.size(); ++i)
      camera.frames[i] = {table.rows[i].timestamp_ns, table.rows[i].angles,
                          "frame " + std::to_string(table.rows[i].frame)};
  }
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

// A recording of Caliscope keeps all cameras' times in one file: sync_index,cam_id,frame_index,
// frame_time [s].
void ReadSharedTimes(const fs::path& file, Footage& footage) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  if (line.rfind("sync_index,cam_id,frame_index,frame_time", 0) != 0)
    throw SetupError(file.string() + ":1: is no table of sync_index,cam_id,frame_index,frame_time");
  std::map<std::string, std::map<int, std::int64_t>> times_ns;
  for (int number = 2; std::getline(in, line); ++number) {
    int sync = 0, id = 0, frame = 0;
    double time_s = 0;
    if (std::sscanf(line.c_str(), "%d,%d,%d,%lf", &sync, &id, &frame, &time_s) != 4)
      throw SetupError(file.string() + ":" + std::to_string(number) + ": is not four numbers");
    times_ns["cam_" + std::to_string(id)][frame] = std::llround(time_s * 1e9);
  }
  for (FootageCamera& camera : footage.cameras) {
    const std::map<int, std::int64_t>& of_camera = times_ns[camera.name];
    if (of_camera.size() != camera.frames.size())
      throw SetupError(file.string() + ": tells times of " + std::to_string(of_camera.size()) +
                       " frames of " + camera.name + "; its video has " +
                       std::to_string(camera.frames.size()));
    camera.timed = true;
    auto time = of_camera.begin();
    for (FootageFrame& frame : camera.frames) frame.time_ns = (time++)->second;
  }
}

// To FFmpeg a picture is a video of one frame.
VideoReader OpenPicture(const fs::path& file) {
  try {
    return VideoReader(file);
  } catch (const SetupError&) {
    throw SetupError(file.string() +
                     ": is no picture that can be read; take it out or save it anew");
  }
}

FootageCamera OpenPictureCamera(const std::string& name, const std::vector<fs::path>& files) {
  FootageCamera camera;
  camera.name = name;
  const VideoReader first = OpenPicture(files.front());
  camera.width_px = first.width_px();
  camera.height_px = first.height_px();
  for (std::size_t i = 0; i < files.size(); ++i)
    camera.frames.push_back(
        {static_cast<std::int64_t>(i) * kUntimedInterval_ns, {}, files[i].filename().string()});
  camera.ForEach = [files, width_px = camera.width_px,
                    height_px = camera.height_px](const auto& use) {
    for (std::size_t i = 0; i < files.size(); ++i) {
      VideoReader picture = OpenPicture(files[i]);
      if (picture.width_px() != width_px || picture.height_px() != height_px)
        throw SetupError(files[i].string() + ": is " + std::to_string(picture.width_px()) + " x " +
                         std::to_string(picture.height_px()) + "; the pictures before it are " +
                         std::to_string(width_px) + " x " + std::to_string(height_px) +
                         "; all of one camera in one resolution are wanted");
      ImageView<const Bgr> pixels;
      picture.Read(pixels);
      use(static_cast<int>(i), pixels);
    }
  };
  return camera;
}

}  // namespace

Footage OpenFootage(const std::filesystem::path& folder) {
  if (!fs::is_directory(folder))
    throw SetupError(folder.string() +
                     ": is no folder; a take or a folder of recordings is wanted");
  Footage footage;
  footage.folder = folder;
  const std::vector<fs::path> recorded = Sorted(folder, IsVideo);
  for (const fs::path& file : recorded) {
    if (!IsSilent(file)) footage.cameras.push_back(OpenVideoCamera(file.stem().string(), file));
  }
  if (footage.cameras.empty() && !recorded.empty())
    throw SetupError(folder.string() +
                     ": holds no frame of any camera; recordings with frames are wanted");
  if (!footage.cameras.empty() && fs::exists(folder / "timestamps.csv"))
    ReadSharedTimes(folder / "timestamps.csv", footage);
  if (footage.cameras.empty()) {
    for (const fs::path& inside :
         Sorted(folder, [](const fs::path& p) { return fs::is_directory(p); })) {
      const std::string name = inside.filename().string();
      const std::vector<fs::path> videos = Sorted(inside, IsVideo);
      const std::vector<fs::path> pictures = Sorted(inside, IsPicture);
      if (videos.size() == 1) footage.cameras.push_back(OpenVideoCamera(name, videos[0]));
      if (videos.empty() && !pictures.empty())
        footage.cameras.push_back(OpenPictureCamera(name, pictures));
    }
  }
  if (footage.cameras.empty()) {
    const std::vector<fs::path> pictures = Sorted(folder, IsPicture);
    if (!pictures.empty())
      footage.cameras.push_back(OpenPictureCamera(folder.filename().string(), pictures));
  }
  if (footage.cameras.empty())
    throw SetupError(
        folder.string() +
        ": holds no recording; cam1.mkv, cam2.mkv ... or a folder of pictures for each "
        "camera is wanted");
  for (const FootageCamera& camera : footage.cameras) {
    if (!IsCameraName(camera.name))
      throw SetupError(folder.string() +
                       ": a recording's name is that of its camera; letters, digits, "
                       "_ and - are wanted");
  }
  return footage;
}

std::vector<FootageMoment> MatchMoments(const Footage& footage) {
  std::int64_t shortest_ns = std::numeric_limits<std::int64_t>::max();
  const bool timed = std::all_of(footage.cameras.begin(), footage.cameras.end(),
                                 [](const FootageCamera& camera) { return camera.timed; });
  const auto time_of = [&](const FootageCamera& camera, std::size_t i) {
    return timed ? camera.frames[i].time_ns : static_cast<std::int64_t>(i) * kUntimedInterval_ns;
  };
  for (const FootageCamera& camera : footage.cameras) {
    for (std::size_t i = 1; i < camera.frames.size(); ++i)
      shortest_ns = std::min(shortest_ns, time_of(camera, i) - time_of(camera, i - 1));
  }
  if (shortest_ns == std::numeric_limits<std::int64_t>::max()) shortest_ns = kUntimedInterval_ns;
  // Cameras' frames in the order of time; a new moment where the last one is too old or taken.
  struct Entry {
    std::int64_t time_ns;
    int camera, frame;
  };
  std::vector<Entry> entries;
  for (std::size_t c = 0; c < footage.cameras.size(); ++c) {
    for (std::size_t i = 0; i < footage.cameras[c].frames.size(); ++i)
      entries.push_back({time_of(footage.cameras[c], i), static_cast<int>(c), static_cast<int>(i)});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.time_ns != b.time_ns ? a.time_ns < b.time_ns : a.camera < b.camera;
  });
  std::vector<FootageMoment> moments;
  for (const Entry& entry : entries) {
    const bool fits = !moments.empty() &&
                      entry.time_ns - moments.back().time_ns <= shortest_ns / 2 &&
                      moments.back().frames[entry.camera] < 0;
    if (!fits) moments.push_back({entry.time_ns, std::vector<int>(footage.cameras.size(), -1)});
    moments.back().frames[entry.camera] = entry.frame;
  }
  return moments;
}

}  // namespace mocap
