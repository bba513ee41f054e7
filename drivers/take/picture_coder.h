// Pictures as they are after lossy video coding.
#pragma once

#include <memory>

#include "core/image.h"

namespace mocap {

/// Codes pictures as H.264, by x264 (without its macroblock tree), and decodes them again: as they
/// come from a camera or a file that compresses them. Coding looks ahead, so pictures come back
/// with a delay.
///
/// The same pictures come back the same. Thread-bound. Starts no threads.
class PictureCoder {
 public:
  /// 0 loses only resolution of colour; higher values need less space.
  static constexpr int kMostCrf = 51;

  /// @param width_px, height_px  even.
  /// @param crf  x264's constant rate factor, from 0.
  /// @throws SetupError  when FFmpeg has no x264.
  PictureCoder(int width_px, int height_px, double fps, int crf);
  PictureCoder(PictureCoder&&) noexcept;
  PictureCoder& operator=(PictureCoder&&) noexcept;
  ~PictureCoder();

  /// Adds the next picture. @pre  Take() has returned false since the last, and Finish() was not
  /// called.
  void Add(ImageView<const Bgr> picture);
  /// Ends the sequence, so that what is missing comes back.
  void Finish();
  /// Takes the next picture, in order; false: add more before, or all have come back.
  bool Take(Image<Bgr>& picture);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap
