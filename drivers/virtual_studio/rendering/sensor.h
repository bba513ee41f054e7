// Image sensor: adds noise and the flicker of the lamps.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"

namespace mocap::simulation {

/// Converts light to bytes. Immutable; reentrant.
class Sensor {
 public:
  explicit Sensor(std::uint64_t seed);

  /// Writes a picture with noise that grows with the light (readout and shot noise).
  /// @param gain  the lamps' brightness, about 1.
  /// @param key   the same key gives the same noise.
  void Expose(const Image<Bgr>& light, double gain, std::uint64_t key, Image<Bgr>& picture) const;

 private:
  std::vector<std::int8_t> noise_;  // Standard deviation 16.
};

/// Brightness of mains lamps at a time: varies by about 1 %, at twice 50 Hz.
double LampGain(std::int64_t capture_ns);

}  // namespace mocap::simulation
