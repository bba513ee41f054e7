// The empty room behind the people of a video.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "tools/import/light_check.h"

namespace mocap {

/// What shows the empty room.
enum class RoomSource {
  kClip,     ///< Another video, without people.
  kStretch,  ///< A part of the video in which nobody is there.
  kItself    ///< Each pixel at the moments at which nobody stood before it.
};

struct RoomRecord {
  RoomSource source = RoomSource::kClip;
  std::size_t pictures = 0;
  double from_s = 0, to_s = 0;  ///< Of a stretch, since the first frame.
  double unseen = 0;            ///< Share of the picture that never was without people.
  LightRange light;             ///< Of the clip and the video together.
};

/// A video whose frames have these times.
struct TimedVideo {
  std::string camera;
  std::filesystem::path file;
  std::span<const std::int64_t> times_ns;

  double SecondsOf(std::size_t frame) const {
    return static_cast<double>(times_ns[frame] - times_ns.front()) / 1e9;
  }
};

/// Stores pictures of a clip of the empty room as the background of a video's camera, in a folder.
/// @throws SetupError  when something moves in it.
RoomRecord TakeRoomFromClip(const TimedVideo& clip, const TimedVideo& video,
                            const std::filesystem::path& folder);

/// Finds the empty room in the video itself, and stores it likewise: in a stretch without people,
/// or else where each place was seen without them.
/// @throws SetupError  when too much of the picture never was without people.
RoomRecord FindRoomInVideo(const TimedVideo& video, const std::filesystem::path& folder);

}  // namespace mocap
