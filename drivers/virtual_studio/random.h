// Random numbers that are the same on every machine and need no state. The standard library's
// distributions may differ between implementations.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "core/geometry.h"

namespace mocap::simulation {

/// Mixes a number into 64 random bits (SplitMix64; Steele, Lea, Flood 2014).
constexpr std::uint64_t Mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Mixes several numbers. The same numbers always give the same bits.
template <typename... More>
constexpr std::uint64_t Mix(std::uint64_t first, std::uint64_t second, More... more) {
  return Mix(Mix(first) ^ second, static_cast<std::uint64_t>(more)...);
}

/// Names a purpose, so that different uses of one seed do not repeat each other.
constexpr std::uint64_t Tag(std::string_view purpose) {
  std::uint64_t bits = 0;
  for (const char c : purpose) bits = Mix(bits, static_cast<std::uint64_t>(c));
  return bits;
}

/// From `low` to `high`, excluding `high`.
struct Range {
  double low = 0, high = 0;
};

/// Draws numbers in sequence. Never draw twice in the arguments of one call or on both sides of an
/// operator: the order of evaluation is unspecified.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(Mix(seed)) {}

  std::uint64_t Bits() { return Mix(state_++); }
  /// Uniform in [low, high).
  double Uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(Bits() >> 11) * 0x1p-53;
  }
  /// Uniform in a box. The last coordinate is drawn first. GCC evaluated arguments in this order,
  /// so earlier seeds keep giving the same studios.
  Vector3 UniformIn(Range x, Range y, Range z) {
    const double at_z = Uniform(z.low, z.high);
    const double at_y = Uniform(y.low, y.high);
    return {Uniform(x.low, x.high), at_y, at_z};
  }
  Vector2 UniformIn(Range x, Range y) {
    const double at_y = Uniform(y.low, y.high);
    return {Uniform(x.low, x.high), at_y};
  }
  /// Standard normal (Box and Muller).
  double Normal() {
    const double radius = std::sqrt(-2 * std::log(1 - Uniform(0, 1)));
    return radius * std::cos(Uniform(0, 2 * std::numbers::pi));
  }

 private:
  std::uint64_t state_;
};

}  // namespace mocap::simulation
