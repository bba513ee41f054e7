#include "drivers/virtual_studio/rendering/sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/virtual_studio/random.h"
#include "drivers/virtual_studio/rendering/light_rows.h"

namespace mocap::simulation {
namespace {

constexpr int kNoiseValues = 1 << 17;

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
