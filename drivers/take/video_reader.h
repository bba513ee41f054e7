// Video files of any kind that FFmpeg decodes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "core/image.h"
#include "drivers/take/picture_turn.h"

namespace mocap {

/// What became of reading a frame.
enum class VideoStatus {
  kFrame,   ///< Here it is.
  kBroken,  ///< A frame that cannot be decoded stood here; reading may go on.
  kEnd      ///< No whole frame is left.
};

/// Decodes a video frame by frame, in the order in which it is shown.
///
/// A file that was cut off ends with its last whole frame. Thread-bound; no threads of its own, and
/// FFmpeg's own messages are switched off.
class VideoReader {
 public:
  /// Opens a file and decodes its first frame.
  /// @throws SetupError  naming the file, when it is missing, is no video, holds no whole frame or
  /// is to be shown turned by other than quarters.
  explicit VideoReader(const std::filesystem::path& file);
  VideoReader(VideoReader&&) noexcept;
  VideoReader& operator=(VideoReader&&) noexcept;
  ~VideoReader();

  /// The size of the frames as they are given: turned as the file says that they are to be shown.
  int width_px() const;
  int height_px() const;
  const PictureTurn& turn() const;
  /// When the frame that was read or passed last is shown, from the file's beginning; empty where
  /// the file does not tell, or frames come from memory.
  std::optional<std::int64_t> time_ns() const;

  /// Gives the next frame; its pixels stay valid until the next call of Read or Skip.
  VideoStatus Read(ImageView<const Bgr>& image);
  /// Passes over the next frame. Lossless video and JPEG are not decoded for that: damage there
  /// goes unnoticed.
  VideoStatus Skip();
  /// Decodes the whole file at once; from then on frames come from memory, the first of them first.
  void KeepInMemory();
  /// Starts over. @throws SetupError  when the file can no longer be opened.
  void Rewind();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Tells whether a video begins well and ends before its first whole frame.
/// @throws SetupError  naming the file, when it is missing or is no video.
bool HoldsNoFrame(const std::filesystem::path& file);

}  // namespace mocap
