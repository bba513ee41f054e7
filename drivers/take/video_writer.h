// Lossless video in a Matroska file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "core/image.h"

namespace mocap {

/// Kind of a video's pixels.
enum class VideoPixels { kBgr, kGray };

/// Codec for colour pictures, always lossless.
enum class VideoCodec {
  kHuffYuv,  ///< Half the size of raw pixels, with little work.
  kFfv1,     ///< A third to a quarter of the size, with much work.
  kRaw       ///< No work.
};

/// Writes each frame independently. Reading restores the same pixels. A truncated file loses only
/// its last frames. Each frame goes to the system at once, so a killed program loses at most the
/// frame being written.
///
/// The same frames give the same bytes. Thread-bound. Starts no threads.
class VideoWriter {
 public:
  /// Creates the file, or truncates it.
  /// @param codec  for colour pictures; gray ones use FFV1.
  /// @throws SetupError  when it cannot be created or the size is invalid.
  VideoWriter(const std::filesystem::path& file, int width_px, int height_px, double fps,
              VideoPixels pixels, VideoCodec codec = VideoCodec::kHuffYuv);
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;
  /// Finishes the file unless Finish was called; then errors are lost.
  ~VideoWriter();

  /// Appends a frame of the kind and size set at construction.
  /// @throws std::runtime_error  when it cannot be written (the disk is full).
  void Write(ImageView<const Bgr> image);
  void Write(ImageView<const std::uint8_t> image);

  /// Completes the file. @throws std::runtime_error  when it cannot be written.
  void Finish();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap
