// The sound of a video file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace mocap {

/// Samples in a second: enough for claps, a small part of a video's memory.
inline constexpr int kSoundRate_hz = 8000;
/// What is longer is not read.
inline constexpr double kLongestSound_s = 3 * 3600;

/// One channel, the mean of all.
struct SoundTrack {
  std::int64_t first_ns = 0;  ///< Time of the first sample on the file's timeline.
  std::vector<std::int16_t> samples;

  double length_s() const { return static_cast<double>(samples.size()) / kSoundRate_hz; }
};

/// Decodes a file's sound. Gaps are silent; what cannot be decoded is left out.
/// @param check  called again and again; may throw to end.
/// @return  empty if there is none.
/// @throws SetupError  naming the file, when it is missing or is no media file.
std::optional<SoundTrack> ReadSound(
    const std::filesystem::path& file, const std::function<void()>& check = [] {});

}  // namespace mocap
