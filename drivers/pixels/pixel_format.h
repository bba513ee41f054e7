// Conversion of cameras' pixel formats to BGR.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "core/image.h"

namespace mocap {

/// Pixel layout. A Bayer pattern is named by its first two rows.
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
  kMjpeg  ///< Each frame is a separate JPEG.
};

/// A frame's bytes; not owned.
struct RawPicture {
  PixelFormat format = PixelFormat::kGrey;
  int width_px = 0, height_px = 0;
  std::size_t stride_bytes = 0;  ///< From row to row; 0: rows have no gaps.
  std::span<const std::uint8_t> bytes;
};

/// Returns the minimum number of bytes per row; 0 for JPEG.
std::size_t LeastRowBytes(PixelFormat format, int width_px);

/// Returns the minimum number of bytes per picture; 1 for JPEG, whose size is not known in advance.
std::size_t LeastBytes(const RawPicture& picture);

/// Returns the bytes per pixel on the wire; for JPEG a typical value.
double TypicalBytesPerPixel(PixelFormat format);

/// Converts pictures to BGR. YUV is taken as BT.601 in video range, as in V4L2 and GenICam. Missing
/// colours of a Bayer pattern are interpolated linearly. Thread-bound.
class PixelConverter {
 public:
  PixelConverter();
  ~PixelConverter();
  PixelConverter(PixelConverter&&) noexcept;
  PixelConverter& operator=(PixelConverter&&) noexcept;

  /// Converts into `out`, whose memory is reused.
  ///
  /// @return  false for a damaged picture: too few bytes, overlapping rows, or not a complete JPEG
  /// of the given size.
  bool Convert(const RawPicture& picture, Image<Bgr>& out);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap
