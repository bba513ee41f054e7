// The mean of pictures, exact to half a grey level.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "core/image.h"

namespace mocap {

/// Adds pictures up. Thread-bound.
class MeanPicture {
 public:
  /// @pre  all pictures have one size.
  void Add(const Image<Bgr>& picture) {
    sums_.resize(picture.pixels().size());
    size_ = {picture.width(), picture.height()};
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const Bgr& pixel = picture.pixels()[i];
      sums_[i][0] += pixel.b, sums_[i][1] += pixel.g, sums_[i][2] += pixel.r;
    }
    ++count_;
  }

  /// @pre  a picture was added.
  Image<Bgr> Mean() const {
    MOCAP_CHECK(count_ > 0);
    Image<Bgr> mean(size_.first, size_.second);
    const auto of = [this](std::uint32_t sum) {
      return static_cast<std::uint8_t>((sum + count_ / 2) / count_);
    };
    for (std::size_t i = 0; i < sums_.size(); ++i)
      mean.pixels()[i] = {of(sums_[i][0]), of(sums_[i][1]), of(sums_[i][2])};
    return mean;
  }

 private:
  std::vector<std::array<std::uint32_t, 3>> sums_;
  std::pair<int, int> size_;
  std::uint32_t count_ = 0;
};

}  // namespace mocap
