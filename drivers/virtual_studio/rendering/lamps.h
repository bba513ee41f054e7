// Lamps of the simulated studio, and what they do not reach.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/geometry.h"
#include "drivers/virtual_studio/people/person_mesh.h"

namespace mocap::simulation {

inline constexpr int kLampCount = 3;
/// Above the ceiling, which lets their light pass.
inline const std::array<Eigen::Vector3f, kLampCount> kLamps_W = {
    Eigen::Vector3f(-1500, -1300, 3700), Eigen::Vector3f(1600, -700, 3700),
    Eigen::Vector3f(-200, 1500, 3700)};
/// Remaining light by number of hidden lamps; full light is 256. Ambient light remains.
inline constexpr std::array<std::uint16_t, kLampCount + 1> kLightLeft = {256, 220, 187, 159};

/// Cells of the plane of the floor; row by row.
struct FloorCells {
  Eigen::Vector2f corner_mm;  ///< The middle of the room, from the corner of the first cell.
  float cell_mm = 1;
  int columns = 0, rows = 0;
  /// Only what is beyond this hides lamps.
  float from_x_W = -std::numeric_limits<float>::infinity();
};

/// Cells that are hidden from lamps.
struct HiddenCells {
  std::vector<std::uint16_t> from;              ///< By cell: a bit for each place of a lamp.
  int x0 = 0, y0 = 0, x1 = -1, y1 = -1;         ///< Cells in use, inclusive.
  std::vector<Eigen::Vector2f> projected = {};  ///< Memory.
};

/// Adds the cells that a mesh hides from one place of a lamp.
/// @param p_W  its vertices.
void Hide(const FloorCells& cells, const Eigen::Vector3f& lamp_W, std::uint16_t bit,
          const PersonMesh& mesh, const std::vector<Eigen::Vector3f>& p_W, HiddenCells& hidden);

}  // namespace mocap::simulation
