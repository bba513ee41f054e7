// §4: contents of square windows of a silhouette, so that the carver can decide whole blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/kernels/octants.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Tells for square windows whether all of their pixels show the person, or all are empty.
///
/// There is one plane per window size, with two bits per position of the window's top left pixel.
/// Sixteen positions make a word, with `inside` in the lower half and `outside` in the upper half.
/// Words of a column are adjacent: lookups of one block are close together, more often one row down
/// than one word to the right. Thread-bound; reuses its memory.
class WindowMap {
 public:
  enum class Kind { kInside, kUnknown, kOutside };

  /// Windows of the first plane are one pixel wide. Each further plane doubles the width.
  static constexpr int kPlanes = kernels::kWindowPlanes;
  static constexpr int kLargest_px = kernels::kWidestWindow_px;

  /// The planes in the form that loops over many windows need.
  using Planes = kernels::WindowPlanes;

  /// Measures a silhouette, and the unknown pixels if there are any.
  /// @param unknown  may be null.
  /// @param box  around both.
  void Measure(const Silhouette& silhouette, const Silhouette* unknown, const PixelBox& box);

  /// Returns the kind of a pixel of the picture.
  Kind At(int x, int y) const {
    if (x < left_ || x > right_ || y < top_ || y > bottom_) return Kind::kOutside;
    const int column = x - left_;
    const std::uint32_t word =
        planes_[static_cast<std::size_t>(column >> 4) * rows_ + (y - top_)] >> (column & 15);
    if (word & 1) return Kind::kInside;
    return word >> 16 & 1 ? Kind::kOutside : Kind::kUnknown;
  }

  Planes planes() const {
    return {planes_.data(), rows_,     2 * columns_ * rows_, left_, top_, right_, bottom_,
            width_px_,      height_px_};
  }

 private:
  // Columns of words, one bit per pixel of a row, with one more on each side.
  using Bits = std::vector<std::uint32_t>;

  void Extract(const Silhouette& silhouette, Bits& bits) const;
  void WritePlanes();
  void Grow(int step);
  // The topmost word of a column; also of the margins left and right.
  std::uint32_t* Column(Bits& bits, int column) const { return bits.data() + (column + 1) * rows_; }

  int width_px_ = 0, height_px_ = 0;
  int left_ = 0, top_ = 0, right_ = -1, bottom_ = -1;
  int rows_ = 0, columns_ = 0;
  Bits inside_, outside_, unknown_;
  std::vector<std::uint32_t> planes_;
};

}  // namespace mocap
