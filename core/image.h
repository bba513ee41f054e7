// Pixels: a non-owning view and an owning image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace mocap {

/// One colour pixel in the layout of OpenCV and FFmpeg's bgr24.
struct Bgr {
  std::uint8_t b = 0, g = 0, r = 0;
  friend bool operator==(const Bgr&, const Bgr&) = default;
};
static_assert(sizeof(Bgr) == 3);

/// A non-owning rectangle of pixels; valid as long as the owner permits.
template <typename T>
class ImageView {
 public:
  ImageView() = default;
  /// @param stride  distance between rows in pixels.
  ImageView(T* data, int width, int height, std::ptrdiff_t stride)
      : data_(data), width_(width), height_(height), stride_(stride) {}
  ImageView(T* data, int width, int height) : ImageView(data, width, height, width) {}
  /// Converts a view of mutable pixels to one of constant pixels.
  operator ImageView<const T>() const requires(!std::is_const_v<T>) {
    return {data_, width_, height_, stride_};
  }

  int width() const { return width_; }
  int height() const { return height_; }
  std::ptrdiff_t stride() const { return stride_; }
  bool empty() const { return width_ == 0 || height_ == 0; }
  T* row(int y) const { return data_ + y * stride_; }
  T& operator()(int x, int y) const { return row(y)[x]; }
  /// Returns a view of a part.
  ImageView Section(int left, int top, int width, int height) const {
    return {row(top) + left, width, height, stride_};
  }

 private:
  T* data_ = nullptr;
  int width_ = 0;
  int height_ = 0;
  std::ptrdiff_t stride_ = 0;
};

/// An owning image, row by row without gaps.
template <typename T>
class Image {
 public:
  Image() = default;
  Image(int width, int height, T fill = T{})
      : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * height, fill) {}

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return pixels_.empty(); }
  T* row(int y) { return pixels_.data() + static_cast<std::size_t>(y) * width_; }
  const T* row(int y) const { return pixels_.data() + static_cast<std::size_t>(y) * width_; }
  T& operator()(int x, int y) { return row(y)[x]; }
  const T& operator()(int x, int y) const { return row(y)[x]; }
  ImageView<T> view() { return {pixels_.data(), width_, height_}; }
  ImageView<const T> view() const { return {pixels_.data(), width_, height_}; }
  std::vector<T>& pixels() { return pixels_; }
  const std::vector<T>& pixels() const { return pixels_; }

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<T> pixels_;
};

}  // namespace mocap
