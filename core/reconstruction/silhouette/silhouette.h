// §4: the person's silhouette in one camera, one bit per pixel.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/image.h"

namespace mocap {

/// A rectangle of pixels; its last column and row are included.
struct PixelBox {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

/// A binary picture with 64 pixels per word. Row y begins at word y * words_per_row(); pixel x is
/// bit x % 64 of word x / 64.
class Silhouette {
 public:
  Silhouette() = default;
  Silhouette(int width, int height)
      : width_(width),
        height_(height),
        words_per_row_((width + 63) / 64),
        words_(static_cast<std::size_t>(words_per_row_) * height) {}

  /// Sets the size and clears every pixel; keeps its memory.
  void Reset(int width, int height) {
    width_ = width;
    height_ = height;
    words_per_row_ = (width + 63) / 64;
    words_.assign(static_cast<std::size_t>(words_per_row_) * height, 0);
    has_box_ = false;
  }

  /// Allocates memory for a picture of this size.
  void Reserve(int width, int height) {
    words_.reserve(static_cast<std::size_t>((width + 63) / 64) * height);
  }

  int width() const { return width_; }
  int height() const { return height_; }
  int words_per_row() const { return words_per_row_; }
  bool Test(int x, int y) const {
    return words_[static_cast<std::size_t>(y) * words_per_row_ + (x >> 6)] >> (x & 63) & 1;
  }
  void Set(int x, int y) { row(y)[x >> 6] |= std::uint64_t{1} << (x & 63); }
  std::uint64_t* row(int y) {
    has_box_ = false;
    return words_.data() + static_cast<std::size_t>(y) * words_per_row_;
  }
  const std::uint64_t* row(int y) const {
    return words_.data() + static_cast<std::size_t>(y) * words_per_row_;
  }
  /// The smallest box around all set pixels; empty if there are none.
  std::optional<PixelBox> BoundingBox() const { return has_box_ ? box_ : FindBox(); }
  /// Finds the bounding box while the pixels are in the cache. It is kept until pixels may change
  /// by Set(), Reset() or a writable row().
  void KeepBox() {
    box_ = FindBox();
    has_box_ = true;
  }
  /// Share of set pixels.
  double CoveredShare() const;
  const std::vector<std::uint64_t>& words() const { return words_; }

 private:
  std::optional<PixelBox> FindBox() const;

  int width_ = 0;
  int height_ = 0;
  int words_per_row_ = 0;
  std::vector<std::uint64_t> words_;
  std::optional<PixelBox> box_;
  bool has_box_ = false;
};

}  // namespace mocap
