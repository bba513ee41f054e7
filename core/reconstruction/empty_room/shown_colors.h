// Beyond the paper: the colours that each pixel showed over a while, and how often.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/empty_room/grey_tolerance.h"

namespace mocap {

/// Counts the colours of each pixel, without keeping pictures: 32 bytes for a pixel. Thread-bound.
class ShownColors {
 public:
  /// Rarer colours than these are forgotten.
  static constexpr int kColors = 4;

  struct Color {
    Bgr mean;
    int pictures = 0;  ///< Those that showed it.
  };

  ShownColors(int width, int height, const GreyTolerance& tolerance);

  /// @pre  the picture has the given size.
  void Add(ImageView<const Bgr> picture);

  int width() const { return width_; }
  int height() const { return height_; }
  int pictures() const { return pictures_; }
  const GreyTolerance& tolerance() const { return tolerance_; }
  /// Returns a pixel's colours, the most frequent first. Those that noise had split are one.
  std::array<Color, kColors> At(std::size_t pixel) const;
  /// The most frequent colour of each pixel.
  Image<Bgr> MostFrequent() const;

 private:
  struct Sum {
    std::array<std::uint16_t, 3> mean{};  // In 256ths of a grey level.
    std::uint16_t count = 0;

    Bgr Mean() const;
    void Add(const Bgr& color);
  };

  const int width_, height_;
  const GreyTolerance tolerance_;
  std::vector<std::array<Sum, kColors>> sums_;
  int pictures_ = 0;
};

}  // namespace mocap
