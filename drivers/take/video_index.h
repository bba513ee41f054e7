// What a video file says of itself: the times of its pictures, its clock, its sound.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mocap {

/// More frames than a day has at 240 Hz: a longer video is no take.
inline constexpr std::size_t kMostVideoFrames = 24UL * 3600 * 240;

struct VideoIndex {
  /// Display time of each coded picture on the file's own timeline, ascending [ns].
  std::vector<std::int64_t> times_ns;
  bool has_sound = false;
  std::string timecode;  ///< SMPTE's "01:00:00:00" of the first picture; empty: none.
  std::string created;   ///< When the file was made, as it says; empty: unknown.
};

/// Reads a video's packets, without decoding any.
/// @param check  called again and again; may throw to end.
/// @throws SetupError  naming the file: missing, no video, no times.
VideoIndex ReadVideoIndex(
    const std::filesystem::path& file, const std::function<void()>& check = [] {});

/// Pictures in a second, without gaps; 0 for fewer than two.
double UsualRateHz(std::span<const std::int64_t> times_ns);

/// Time since midnight of a timecode [ns]. Drop-frame timecodes have a semicolon.
/// @param frames_hz  pictures in a second; timecodes count the nearest of 24, 25, 30 and so on, or
/// of 1000/1001 of it.
/// @return  empty for anything else.
std::optional<std::int64_t> TimeOfTimecode(const std::string& timecode, double frames_hz);

/// A moment since the Unix epoch, as files tell it.
struct CreationTime {
  std::int64_t epoch_ns = 0;
  bool is_whole_second = true;  ///< Nothing smaller is told.
};

/// Parses "2026-11-21T20:05:00.250000Z" and "2026-11-21T20:05:00+0100". Empty for anything else.
std::optional<CreationTime> CreationTimeFromText(const std::string& text);

}  // namespace mocap
