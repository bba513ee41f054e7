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

/// Frames without times lie so far apart: only their order counts.
constexpr std::int64_t kUntimedInterval_ns = 1'000'000'000;

/// One picture of a recording.
struct FootageFrame {
  std::int64_t time_ns = 0;
  PanTiltAngles angles;
  std::string name;  ///< For messages: "frame 12" or a file's name.
  std::string key;   ///< Of a picture: what its name has in common with those of the same moment.
};

/// One camera's recording.
struct FootageCamera {
  std::string name;
  int width_px = 0, height_px = 0;
  std::vector<FootageFrame> frames;
  bool timed = false;  ///< Times are captured ones.
  bool placed =
      false;  ///< Times of different cameras can be compared; otherwise they count frames.
  /// Calls `use` for each picture in order, with its number.
  std::function<void(const std::function<void(int, ImageView<const Bgr>)>& use)> ForEach;
};

struct Footage {
  std::filesystem::path folder;
  std::vector<FootageCamera> cameras;
  std::vector<std::string> notes;  ///< What a person should know of how it was read, a line each.
};

/// Opens a take, a folder with one video a camera (cam1.mkv, cam1.mp4, cam1.avi …; cam1.csv beside
/// it, or Caliscope's timestamps.csv, tells times), or a folder with a folder of pictures or one
/// video for each camera. Pictures of one moment have the same number, or else name. Hidden files
/// are passed over.
/// @throws SetupError  when there is nothing of that kind, a picture cannot be read or pictures of
/// one camera differ in size.
Footage OpenFootage(const std::filesystem::path& folder);

/// Moments at which cameras took pictures: number of each camera's frame, or -1.
struct FootageMoment {
  std::int64_t time_ns = 0;
  std::vector<int> frames;
};

/// Matches frames by capture time; where a camera has none, by the times in the videos or the names
/// of the pictures; and by their order where a camera has neither. Frames farther apart than half
/// of the shortest interval do not match.
std::vector<FootageMoment> MatchMoments(const Footage& footage);

/// Reads the times of a recording of Caliscope: a table with the columns cam_id (or port) and
/// frame_time [s], and frame_index where frames are not in order. @throws SetupError
void ReadSharedTimes(const std::filesystem::path& file, Footage& footage);

/// Gives pictures of the same moment the same time, by the keys of their names.
void PairPictures(Footage& footage);

/// Finds what tells a camera's pictures apart and from which they can be put in order: a number in
/// their names, without its leading zeros, or else the names. In the order of the files.
std::vector<std::string> PictureKeys(const std::vector<std::filesystem::path>& files);

/// Compares two such keys: numbers by value, all else as texts.
bool IsKeyLess(const std::string& a, const std::string& b);

}  // namespace mocap
