#include "drivers/simulation/sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/vectorized.h"
#include "drivers/simulation/random.h"

namespace mocap::simulation {
namespace {

constexpr int kNoiseValues = 1 << 17;

// 16-bit arithmetic with 6 fractional bits, which compilers vectorize. The lamps' gain is in 64ths
// and 16384ths.
MOCAP_VECTORIZED void ExposeRow(const std::uint8_t* light, const std::int8_t* noise,
                                std::uint16_t gain, std::uint16_t fine_gain, std::uint8_t* picture,
                                int count) {
  for (int i = 0; i < count; ++i) {
    const std::uint16_t level = light[i];
    const auto coarse = static_cast<std::int16_t>(level * gain);
    const auto fine =
        static_cast<std::uint16_t>(static_cast<std::uint16_t>(level * fine_gain) >> 8);
    // Standard deviation 1.1 in the dark to 2.8 in white.
    const auto amplitude = static_cast<std::int16_t>(18 + ((level * 7) >> 6));
    const auto grain =
        static_cast<std::int16_t>(static_cast<std::int16_t>(noise[i] * amplitude) >> 2);
    const auto sum = static_cast<std::int16_t>(coarse + fine + grain + 32);
    const auto value = static_cast<std::int16_t>(sum >> 6);
    picture[i] = static_cast<std::uint8_t>(std::clamp(value, std::int16_t{0}, std::int16_t{255}));
  }
}

}  // namespace

Sensor::Sensor(std::uint64_t seed) {
  Random random(Mix(seed, Tag("sensor")));
  noise_.resize(kNoiseValues);
  for (std::int8_t& value : noise_)
    value = static_cast<std::int8_t>(std::lround(std::clamp(random.Normal(), -4.0, 4.0) * 16));
}

void Sensor::Expose(const Image<Bgr>& light, double gain, std::uint64_t key,
                    Image<Bgr>& picture) const {
  if (picture.width() != light.width() || picture.height() != light.height())
    picture = Image<Bgr>(light.width(), light.height());
  const int count = 3 * light.width();
  const auto gain_fixed = static_cast<std::uint32_t>(std::lround(gain * 64 * 256));
  const auto coarse = static_cast<std::uint16_t>(gain_fixed >> 8);
  const auto fine = static_cast<std::uint16_t>(gain_fixed & 255);
  for (int y = 0; y < light.height(); ++y) {
    // Each row takes its noise from a random place of the table.
    const std::uint64_t offset =
        Mix(key, static_cast<std::uint64_t>(y)) % static_cast<std::uint64_t>(kNoiseValues - count);
    ExposeRow(reinterpret_cast<const std::uint8_t*>(light.row(y)), noise_.data() + offset, coarse,
              fine, reinterpret_cast<std::uint8_t*>(picture.row(y)), count);
  }
}

double LampGain(std::int64_t capture_ns) {
  constexpr std::int64_t kPeriod_ns = 10'000'000;
  const double phase = static_cast<double>(capture_ns % kPeriod_ns) / kPeriod_ns;
  return 1 + 0.01 * std::sin(2 * std::numbers::pi * phase);
}

}  // namespace mocap::simulation
