// The shadow that the person casts on the floor, soft because several lamps make it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "drivers/simulation/empty_view.h"
#include "drivers/simulation/person_mesh.h"

namespace mocap::simulation {

/// Casts and draws shadows; reuses its memory. Thread-bound.
class FloorShadow {
 public:
  FloorShadow();

  /// Takes all shadows away.
  void Clear();
  /// Projects a mesh from each lamp to the floor. The light is that of the last Blur().
  void Cast(const PersonMesh& mesh, const std::vector<Eigen::Vector3f>& p_W);
  /// Makes the shadows that were cast soft, and lets light fall; once after Clear().
  void Blur();
  /// World rectangle that holds the shadow [mm]; false when there is none.
  bool Bounds(Eigen::Vector2f& low_W, Eigen::Vector2f& high_W) const;
  /// Whether any of some places may lie in the shadow.
  bool MayFallOn(std::span<const FloorPlace> places) const;
  /// Light that arrives at a place: 256 without shadow.
  int LightAt(FloorPlace place) const {
    // Between the centres of four cells.
    const int px = place.x - 128, py = place.y - 128;
    const int x = px >> 8, y = py >> 8;
    if (x < x0_ || y < y0_ || x >= x1_ || y >= y1_) return 256;
    const std::uint16_t* row = &light_[y * columns_ + x];
    if ((row[0] & row[1] & row[columns_] & row[columns_ + 1]) == 256) return 256;
    const int u = px & 255, v = py & 255;
    const int top = row[0] * (256 - u) + row[1] * u;
    const int bottom = row[columns_] * (256 - u) + row[columns_ + 1] * u;
    return (top * (256 - v) + bottom * v) >> 16;
  }

 private:
  void CastFrom(const Eigen::Vector3f& lamp_W, std::uint8_t bit, const PersonMesh& mesh,
                const std::vector<Eigen::Vector3f>& p_W);

  std::vector<std::uint8_t> lamps_hidden_;  // A bit a lamp.
  std::vector<std::uint16_t> light_, scratch_;
  std::vector<std::uint16_t> line_;  // Of cells, with its ends repeated.
  std::vector<Eigen::Vector2f> projected_;
  int columns_;
  int x0_ = 0, y0_ = 0, x1_ = -1, y1_ = -1;  // Cells in use, inclusive.
};

}  // namespace mocap::simulation
