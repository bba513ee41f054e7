// Recorded pictures of a board: a take, a folder of videos or folders of pictures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Interval between frames without times: only their order counts.
constexpr std::int64_t kUntimedInterval_ns = 1'000'000'000;

/// One picture of a recording.
struct FootageFrame {
  std::int64_t time_ns = 0;
  PanTiltAngles angles;
  std::string name;  ///< For messages: "frame 12" or a file name.
  std::string key;   ///< Of a picture: the part of its name that it shares with pictures of the
                     ///< same moment.
};

/// One camera's recording.
struct FootageCamera {
  std::string name;
  int width_px = 0, height_px = 0;
  std::vector<FootageFrame> frames;
  bool timed = false;  ///< Times are capture times.
  bool placed =
      false;  ///< Times of different cameras can be compared; otherwise they count frames.
  /// Calls `use` for each picture in order, with its index.
  std::function<void(const std::function<void(int, ImageView<const Bgr>)>& use)> ForEach;
};

struct Footage {
  std::filesystem::path folder;
  std::vector<FootageCamera> cameras;
  std::vector<std::string> notes;  ///< Remarks on how it was read, for people, one line each.
};

/// Opens a take; a folder with one video per camera (cam1.mkv, cam1.mp4, cam1.avi …; times from
/// cam1.csv, or Caliscope's timestamps.csv); or a folder with a folder of pictures or one video for
/// each camera. Pictures of one moment have the same number, or else name. Skips hidden files.
/// @throws SetupError  when there is nothing of that kind, a picture cannot be read or is of a kind
/// that is not, or pictures of one camera differ in size.
Footage OpenFootage(const std::filesystem::path& folder);

/// A moment of the recording: index of each camera's frame, or -1.
struct FootageMoment {
  std::int64_t time_ns = 0;
  std::vector<int> frames;
};

/// Matches frames by capture time. Without it, by times in the videos or names of the pictures; and
/// without either, by order. Frames farther apart than half of the shortest interval do not match.
std::vector<FootageMoment> MatchMoments(const Footage& footage);

/// Reads the times of a Caliscope recording: a table with the columns cam_id (or port), frame_time
/// [s], and frame_index if frames are not in order. @throws SetupError
void ReadSharedTimes(const std::filesystem::path& file, Footage& footage);

/// Gives pictures of the same moment the same time, by their keys.
void PairPictures(Footage& footage);

/// Finds keys that distinguish and sort a camera's pictures: a number in their names, without
/// leading zeros, or else the names. In the order of the files.
std::vector<std::string> PictureKeys(const std::vector<std::filesystem::path>& files);

/// Compares two keys: numbers by value, others as text.
bool IsKeyLess(const std::string& a, const std::string& b);

}  // namespace mocap
