// Recorded pictures of a board, camera by camera: a take, a folder of videos or folders of
// pictures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// One picture of a recording.
struct FootageFrame {
  std::int64_t time_ns = 0;
  PanTiltAngles angles;
  std::string name;  ///< For messages: "frame 12" or a file's name.
};

/// One camera's recording.
struct FootageCamera {
  std::string name;
  int width_px = 0, height_px = 0;
  std::vector<FootageFrame> frames;
  bool timed = false;  ///< Times are captured ones; otherwise they count frames.
  /// Calls `use` for each picture in order, with its number.
  std::function<void(const std::function<void(int, ImageView<const Bgr>)>& use)> ForEach;
};

struct Footage {
  std::filesystem::path folder;
  std::vector<FootageCamera> cameras;
};

/// Opens a take, a folder with one video a camera (cam1.mkv, cam1.mp4, cam1.avi …; cam1.csv beside
/// it tells times), or a folder with a folder of pictures or one video for each camera.
/// @throws SetupError  when there is nothing of that kind, a picture cannot be read or pictures of
/// one camera differ in size.
Footage OpenFootage(const std::filesystem::path& folder);

/// Moments at which cameras took pictures: number of each camera's frame, or -1.
struct FootageMoment {
  std::int64_t time_ns = 0;
  std::vector<int> frames;
};

/// Matches frames by capture time, or by their order where a camera has no times. Frames farther
/// apart than half of the shortest interval do not match.
std::vector<FootageMoment> MatchMoments(const Footage& footage);

}  // namespace mocap
