// Learns the empty studio of a fixed camera from pictures in which people move about.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/reconstruction/empty_room/moved_things.h"
#include "drivers/background_source.h"

namespace mocap {

/// Pictures a second, and the most of them: successive pictures of a person who walks have little
/// in common then.
inline constexpr double kOccupiedFps = 2;
inline constexpr int kMostOccupiedPictures = 200;

struct OccupiedRoom {
  std::string camera;
  BackgroundSource pictures;               ///< In the order of their times; read several times.
  std::optional<BackgroundSource> stored;  ///< The background until now; empty: none.
  /// Whether what was moved becomes part of the background.
  bool is_accepted = false;
};

/// What was learned of one camera.
struct OccupiedRecord {
  std::string camera;
  int width_px = 0, height_px = 0;
  std::size_t pictures = 0;
  double unseen = 0;       ///< Share of the picture that was never seen empty.
  bool is_filled = false;  ///< There, the stored background remains.
  double unknown = 0;      ///< Share that it does not know, either.
  std::vector<MovedThing> moved = {};
  bool is_accepted = false;
};

/// Writes pictures of the empty studio as a background video, and beside it what is unknown of it.
/// @throws SetupError  when too little can be learned: too few pictures, too much that was never
/// seen, or a picture that differs as a whole from the stored one.
OccupiedRecord LearnOccupied(const OccupiedRoom& room, const std::filesystem::path& video);

/// Learns from the pictures in FOLDER/CAMERA.mkv, or others, and puts there what was learned.
/// @throws  as LearnOccupied.
OccupiedRecord LearnInPlace(const OccupiedRoom& room, const std::filesystem::path& folder);

/// Every `step`-th picture of a video, with the mask beside it.
/// @param check  called before each picture; may throw to end.
BackgroundSource PicturesOf(const std::filesystem::path& file, int step,
                            std::function<void()> check);

/// @throws SetupError  if an accepted camera is not there.
void RequireAccepted(const std::vector<std::string>& accepted,
                     const std::vector<std::string>& cameras);

/// Describes a record for people, one line for the camera and one for each of the largest moved
/// things.
std::vector<std::string> TextOf(const OccupiedRecord& record);

}  // namespace mocap
