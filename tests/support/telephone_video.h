// A video as telephones write them: with a turn, and with frames that come as they please.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "tests/support/gray_video.h"

namespace mocap::testing {

/// What "held upright" writes: the picture is to be turned right by 90 degrees.
inline constexpr std::array<std::int32_t, 9> kHeldUpright = {0, 65536, 0, -65536, 0,
                                                             0, 0,     0, 1 << 30};

/// Writes gray frames of 64 x 32 pixels, white in the top left quarter alone.
/// @param times_ms  of the frames, ascending.
inline void WriteTelephoneVideo(const std::filesystem::path& file,
                                const std::vector<std::int64_t>& times_ms,
                                const std::array<std::int32_t, 9>& matrix) {
  av_log_set_level(AV_LOG_QUIET);
  constexpr int kWidth = 64, kHeight = 32;
  WriteGrayVideo(file, {.container = "mov",
                        .width_px = kWidth,
                        .height_px = kHeight,
                        .time_base = {1, 1000},
                        .times = times_ms,
                        .duration = 33,
                        .display_matrix = matrix,
                        .pixel = [](int, int x, int y) -> std::uint8_t {
                          return x < kWidth / 2 && y < kHeight / 2 ? 255 : 0;
                        }});
}

}  // namespace mocap::testing
