// Makes a take of videos that were not recorded by mocapd.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "tools/import/room_background.h"
#include "tools/import/synchronize.h"

namespace mocap {

struct ImportRequest {
  std::vector<std::string> videos, backgrounds;  ///< As in MatchVideos.
  std::filesystem::path calibration;             ///< For messages.
  std::vector<CameraCalibration> cameras;
  std::filesystem::path out;
  SyncRequest sync;
  std::string offsets;  ///< As in ParseOffsets; empty: none.
};

/// What was found of a video, and what became of it.
struct ImportedCamera {
  CameraCalibration calibration;
  std::filesystem::path file, clip;  ///< Clip of the empty room; may be empty.
  VideoIndex index;
  std::string turn;  ///< Of its pictures; empty: none.
  double rate_hz = 0;
  bool has_variable_rate = false;
  CameraClock clock;
  RoomRecord room;
  std::vector<std::int64_t> times_ns;      ///< Of its frames, in the take.
  double apart_ms = 0, most_apart_ms = 0;  ///< To the pictures of the fastest camera.
};

struct ImportedTake {
  std::vector<ImportedCamera> cameras;
  double common_s = 0;  ///< What all of them show.
  std::vector<std::string> remarks;
};

/// Checks all videos, synchronizes them, finds the empty room, and writes the take.
///
/// Pictures stay coded as they are, unless Matroska cannot hold them. Everything that can be told
/// without decoding is checked first.
/// @throws SetupError  naming camera or file; std::runtime_error  when something cannot be written.
/// Nothing is left behind then.
ImportedTake ImportTake(const ImportRequest& request);

}  // namespace mocap
