// Pixels as cameras send them, turned into blue, green and red.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "core/image.h"

namespace mocap {

/// How a camera lays out its pixels. A Bayer pattern is named by its first two rows.
enum class PixelFormat {
  kYuyv,  ///< 4:2:2, two pixels in Y U Y V.
  kUyvy,  ///< 4:2:2, two pixels in U Y V Y; GenICam's YUV422Packed.
  kNv12,  ///< 4:2:0, a plane of Y, then one of U V pairs.
  kGrey,
  kRgb,
  kBgr,
  kBayerRggb,
  kBayerGrbg,
  kBayerGbrg,
  kBayerBggr,
  kMjpeg  ///< Each frame a JPEG of its own.
};

/// A frame's bytes, borrowed.
struct RawPicture {
  PixelFormat format = PixelFormat::kGrey;
  int width_px = 0, height_px = 0;
  std::size_t stride_bytes = 0;  ///< From row to row; 0: rows follow each other without gaps.
  std::span<const std::uint8_t> bytes;
};

/// Gives the bytes that a row takes at least; for JPEG 0.
std::size_t LeastRowBytes(PixelFormat format, int width_px);

/// Gives the bytes that a picture takes at least; for JPEG 1, since only reading it tells.
std::size_t LeastBytes(const RawPicture& picture);

/// Gives the bytes a pixel that cross the wire; for JPEG what cameras usually need.
double TypicalBytesPerPixel(PixelFormat format);

/// Turns pictures into pixels of our own. YUV is taken for BT.601 in video range, as V4L2 and
/// GenICam have it; colours missing in a Bayer pattern are interpolated linearly. Thread-bound.
class PixelConverter {
 public:
  PixelConverter();
  ~PixelConverter();
  PixelConverter(PixelConverter&&) noexcept;
  PixelConverter& operator=(PixelConverter&&) noexcept;

  /// Converts into `out`, whose memory is reused.
  /// @return  false for a damaged picture: too few bytes, rows that overlap, or no whole JPEG of
  /// the size named.
  bool Convert(const RawPicture& picture, Image<Bgr>& out);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap
