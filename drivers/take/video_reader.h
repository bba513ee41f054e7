// Reads all video files that FFmpeg can decode.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "core/image.h"
#include "drivers/take/picture_turn.h"

namespace mocap {

/// Result of reading a frame.
enum class VideoStatus {
  kFrame,   ///< A frame was read.
  kBroken,  ///< A frame could not be decoded; reading may continue.
  kEnd      ///< No complete frame is left.
};

/// Decodes a video frame by frame, in display order.
///
/// A truncated file ends with its last complete frame. Thread-bound. Starts no threads, and
/// disables FFmpeg's messages.
class VideoReader {
 public:
  /// Opens a file and decodes its first frame.
  /// @throws SetupError  naming the file, when it is missing, is not a video, has no complete
  /// frame, or its rotation is not by quarter turns.
  explicit VideoReader(const std::filesystem::path& file);
  VideoReader(VideoReader&&) noexcept;
  VideoReader& operator=(VideoReader&&) noexcept;
  ~VideoReader();

  /// Size of the frames as delivered: rotated for display.
  int width_px() const;
  int height_px() const;
  const PictureTurn& turn() const;
  /// Display time of the last frame read or skipped, from the file's beginning. Empty if the file
  /// has no times, or frames come from memory.
  std::optional<std::int64_t> time_ns() const;

  /// Reads the next frame; its pixels are valid until the next Read or Skip.
  VideoStatus Read(ImageView<const Bgr>& image);
  /// Skips the next frame. Lossless video and JPEG are not decoded; damage there stays unnoticed.
  VideoStatus Skip();
  /// Decodes the whole file. Then frames come from memory, starting with the first.
  void KeepInMemory();
  /// Goes back to a frame that was read or skipped before, so that it is next.
  /// @param frame  number of frames before it.
  /// @return  false: the video's times do not tell where it is. Rewind to go on.
  bool ReturnTo(std::size_t frame);
  /// Goes to the first frame at or after a time, so that it is next. What lies far before it is not
  /// decoded. ReturnTo works no more until Rewind.
  /// @return  false: there is none.
  bool GoTo(std::int64_t time_ns);
  /// Goes back to the start. @throws SetupError  when the file can no longer be opened.
  void Rewind();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether a video has a valid beginning but ends before its first complete frame.
/// @throws SetupError  naming the file, when it is missing or is not a video.
bool HoldsNoFrame(const std::filesystem::path& file);

}  // namespace mocap
