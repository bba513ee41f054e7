// Rows of simulated light, compiled for each kind of processor as the kernels of core are.
#pragma once

#include <cstddef>
#include <cstdint>

#include "drivers/virtual_studio/rendering/empty_view.h"

namespace mocap::simulation {

/// Counts places within a rectangle that begins at `low`.
int CountWithin(const FloorPlace* places, std::size_t count, FloorPlace low, FloorPlace size);

/// Averages three rows.
void AverageThree(const std::uint16_t* a, const std::uint16_t* b, const std::uint16_t* c, int count,
                  std::uint16_t* means);

/// Exposes pixels: amplifies the light and adds noise.
/// @param gain, fine_gain  in 1/64 and 1/16384.
void ExposeRow(const std::uint8_t* light, const std::int8_t* noise, std::uint16_t gain,
               std::uint16_t fine_gain, std::uint8_t* picture, int count);

}  // namespace mocap::simulation
