#include "drivers/virtual_studio/rendering/light_rows.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "drivers/virtual_studio/rendering/light_rows.cpp"
#include "core/kernels/each_target.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::simulation::HWY_NAMESPACE {
namespace {

int CountAll(const FloorPlace* places, std::size_t count, FloorPlace low, FloorPlace size) {
  int within = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<std::uint16_t>(places[i].x - low.x);
    const auto y = static_cast<std::uint16_t>(places[i].y - low.y);
    within += static_cast<int>(x < size.x) & static_cast<int>(y < size.y);
  }
  return within;
}

void AverageAll(const std::uint16_t* a, const std::uint16_t* b, const std::uint16_t* c, int count,
                std::uint16_t* means) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i)
    means[i] = static_cast<std::uint16_t>((a[i] + b[i] + c[i] + 1) / 3);
}

// 16-bit arithmetic with 6 fractional bits, which compilers vectorize. The lamps' gain is in 64ths
// and 16384ths.
void ExposeAll(const std::uint8_t* light, const std::int8_t* noise, std::uint16_t gain,
               std::uint16_t fine_gain, std::uint8_t* picture, int count) {
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
}  // namespace mocap::simulation::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::simulation {

HWY_EXPORT(CountAll);
int CountWithin(const FloorPlace* places, std::size_t count, FloorPlace low, FloorPlace size) {
  return HWY_DYNAMIC_DISPATCH(CountAll)(places, count, low, size);
}

HWY_EXPORT(AverageAll);
void AverageThree(const std::uint16_t* a, const std::uint16_t* b, const std::uint16_t* c, int count,
                  std::uint16_t* means) {
  HWY_DYNAMIC_DISPATCH(AverageAll)(a, b, c, count, means);
}

HWY_EXPORT(ExposeAll);
void ExposeRow(const std::uint8_t* light, const std::int8_t* noise, std::uint16_t gain,
               std::uint16_t fine_gain, std::uint8_t* picture, int count) {
  HWY_DYNAMIC_DISPATCH(ExposeAll)(light, noise, gain, fine_gain, picture, count);
}

}  // namespace mocap::simulation
#endif  // HWY_ONCE
