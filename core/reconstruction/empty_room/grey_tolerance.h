// Beyond the paper: how much an unchanged place differs from itself, from picture to picture.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>

#include "core/image.h"

namespace mocap {

/// Largest difference of an unchanged place from its usual colour, in each channel [grey levels].
struct GreyTolerance {
  std::array<std::uint8_t, 256> of{};  ///< By the usual value.

  bool Accepts(const Bgr& usual, const Bgr& seen) const {
    return std::abs(usual.b - seen.b) <= of[usual.b] && std::abs(usual.g - seen.g) <= of[usual.g] &&
           std::abs(usual.r - seen.r) <= of[usual.r];
  }
};

/// Measures noise by the differences between successive pictures: people who move change
/// only a small part of each. Thread-bound.
class NoiseMeter {
 public:
  /// @pre  all pictures have one size.
  void Add(ImageView<const Bgr> picture);

  /// @pre  at least two pictures were added.
  GreyTolerance Tolerance() const;

 private:
  static constexpr int kBins = 16;  // Of brightness: shot noise grows with light.

  Image<Bgr> before_;
  std::array<std::array<std::int64_t, 256>, kBins> counts_{};  // Of differences.
};

}  // namespace mocap
