// §4: what square windows hold of a silhouette, which lets the carver decide whole blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Tells of the square windows in a picture whether all of one lies in the silhouette, or all of it
/// outside the silhouette with its gaps closed.
///
/// A map is made of planes, one for each size of window, with two bits for each place of the
/// window's top left pixel: sixteen places make a word, `inside` in its lower half and `outside` in
/// its upper one. Words that lie one below the other follow one another, for what is looked up at
/// once is near, and a row lower more often than a word to the right. Thread-bound; reuses its
/// memory.
class WindowMap {
 public:
  enum class Kind { kInside, kGap, kOutside };

  /// The windows of the first plane are a pixel; those of each other twice as wide as the one's
  /// before.
  static constexpr int kPlanes = 6;
  static constexpr int kLargest_px = 1 << (kPlanes - 1);
  /// Half the width of the gaps that are closed [px].
  static constexpr int kGap_px = 6;

  /// Planes as loops over many windows want them.
  struct Planes {
    const std::uint32_t* words = nullptr;
    int words_per_column = 0, words_per_plane = 0;
    /// The region beside which all is outside, its last column and row included.
    int left = 0, top = 0, right = -1, bottom = -1;
    int width_px = 0, height_px = 0;  ///< Of the picture.
  };

  /// Measures a silhouette.
  /// @param box  the silhouette's.
  void Measure(const Silhouette& silhouette, const PixelBox& box, bool closes_gaps);

  /// Tells what a pixel of the picture is.
  Kind At(int x, int y) const {
    if (x < left_ || x > right_ || y < top_ || y > bottom_) return Kind::kOutside;
    const int column = x - left_;
    const std::uint32_t word =
        planes_[static_cast<std::size_t>(column >> 4) * rows_ + (y - top_)] >> (column & 15);
    if (word & 1) return Kind::kInside;
    return word >> 16 & 1 ? Kind::kOutside : Kind::kGap;
  }

  Planes planes() const {
    return {planes_.data(), rows_,     2 * columns_ * rows_, left_, top_, right_, bottom_,
            width_px_,      height_px_};
  }

 private:
  // Columns of words, a bit a pixel of a row, with margins all around.
  using Bits = std::vector<std::uint32_t>;

  void Extract(const Silhouette& silhouette);
  void CloseGaps();
  void SetMargins(bool set_beyond_picture, Bits& bits) const;
  void WritePlanes();
  void Grow(int step);
  // The topmost word of a column; of the margins beside them, too.
  std::uint32_t* Column(Bits& bits, int column) const {
    return bits.data() + (column + 1) * stride_ + kGap_px;
  }
  // From the topmost word of the first column to the lowest of the last.
  int WordsBetween() const { return columns_ * stride_ - 2 * kGap_px; }

  int width_px_ = 0, height_px_ = 0;
  int left_ = 0, top_ = 0, right_ = -1, bottom_ = -1;
  int rows_ = 0, columns_ = 0;
  int stride_ = 0;  ///< From a column to the next.
  Bits inside_, outside_, scratch_;
  std::vector<std::uint32_t> planes_;
};

}  // namespace mocap
