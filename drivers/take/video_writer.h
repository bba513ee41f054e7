// Lossless video in a Matroska file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "core/image.h"

namespace mocap {

/// What a video's pixels are.
enum class VideoPixels { kBgr, kGray };

/// How colour pictures are stored, always without loss.
enum class VideoCodec {
  kHuffYuv,  ///< Half the size of raw pixels, for little work.
  kFfv1,     ///< A third to a quarter of the size, for much work.
  kRaw       ///< No work at all.
};

/// Writes every frame on its own: reading gives back the same pixels, and a file that was cut off
/// loses no more than its last frames. Each frame goes to the system at once, so that a program
/// that is killed loses no more than the one that it was writing.
///
/// The same frames give the same bytes. Thread-bound; no threads of its own.
class VideoWriter {
 public:
  /// Creates the file, or empties it.
  /// @param codec  of colour pictures; gray ones are FFV1.
  /// @throws SetupError  when it cannot be created or the size is not one of a picture.
  VideoWriter(const std::filesystem::path& file, int width_px, int height_px, double fps,
              VideoPixels pixels, VideoCodec codec = VideoCodec::kHuffYuv);
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;
  /// Finishes the file if Finish was not called; errors are lost then.
  ~VideoWriter();

  /// Appends a frame of the kind and size given at construction.
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
