#include "drivers/simulation/sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/simulation/random.h"

namespace mocap::simulation {
namespace {

constexpr int kNoiseValues = 1 << 17;

// Fixed point with 6 fractional bits, written so that compilers turn it into vector code.
void ExposeRow(const std::uint8_t* light, const std::int16_t* noise, std::int16_t gain,
               std::uint8_t* picture, int count) {
  for (int i = 0; i < count; ++i) {
    const auto level = static_cast<std::int16_t>(light[i] << 6);
    const auto flicker = static_cast<std::int16_t>((level * gain) >> 16);
    // Standard deviation 1.1 in the dark to 2.9 in white.
    const auto amplitude = static_cast<std::int16_t>(1126 + light[i] * 7);
    const auto grain = static_cast<std::int16_t>((noise[i] * amplitude) >> 16);
    const auto sum = static_cast<std::int16_t>(level + flicker + grain + 32);
    const auto value = static_cast<std::int16_t>(sum >> 6);
    picture[i] = static_cast<std::uint8_t>(std::clamp(value, std::int16_t{0}, std::int16_t{255}));
  }
}

}  // namespace

Sensor::Sensor(std::uint64_t seed) {
  Random random(Mix(seed, 0x73656e736f72));
  noise_.resize(kNoiseValues);
  for (std::int16_t& value : noise_)
    value = static_cast<std::int16_t>(std::lround(std::clamp(random.Normal(), -4.0, 4.0) * 4096));
}

void Sensor::Expose(const Image<Bgr>& light, double gain, std::uint64_t key,
                    Image<Bgr>& picture) const {
  if (picture.width() != light.width() || picture.height() != light.height())
    picture = Image<Bgr>(light.width(), light.height());
  const int count = 3 * light.width();
  const auto gain16 = static_cast<std::int16_t>(std::lround((gain - 1) * 65536));
  for (int y = 0; y < light.height(); ++y) {
    // Rows take their noise from random places of the table.
    const std::uint64_t offset =
        Mix(key, static_cast<std::uint64_t>(y)) % static_cast<std::uint64_t>(kNoiseValues - count);
    ExposeRow(&light.row(y)->b, noise_.data() + offset, gain16, &picture.row(y)->b, count);
  }
}

double LampGain(std::int64_t capture_ns) {
  constexpr std::int64_t kPeriod_ns = 10'000'000;
  const double phase = static_cast<double>(capture_ns % kPeriod_ns) / kPeriod_ns;
  return 1 + 0.01 * std::sin(2 * std::numbers::pi * phase);
}

}  // namespace mocap::simulation
