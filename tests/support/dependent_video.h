// A video whose frames need those before them, as other programs write FFV1.
#pragma once

#include <cstdint>
#include <filesystem>
#include <numeric>
#include <vector>

#include "tests/support/gray_video.h"

namespace mocap::testing {

/// The noise in frame `frame` of the video below.
inline std::uint8_t NoiseAt(int frame, int x, int y) {
  return static_cast<std::uint8_t>((x * 7919u + y * 104729u + frame * 31u) * 2654435761u >> 24);
}

/// Writes gray frames, every fifth of which stands on its own.
inline void WriteVideoOfDependentFrames(const std::filesystem::path& file, int width_px,
                                        int height_px, int frames) {
  std::vector<std::int64_t> times(frames);
  std::iota(times.begin(), times.end(), 0);
  WriteGrayVideo(file, {.width_px = width_px,
                        .height_px = height_px,
                        .keyframe_every = 5,
                        .times = times,
                        .pixel = NoiseAt});
}

}  // namespace mocap::testing
