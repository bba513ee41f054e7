// Shadow of a person on the floor; soft because of several lamps.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "drivers/virtual_studio/people/person_mesh.h"
#include "drivers/virtual_studio/rendering/empty_view.h"
#include "drivers/virtual_studio/rendering/lamps.h"

namespace mocap::simulation {

/// Computes and draws shadows; reuses its memory. Thread-bound.
class FloorShadow {
 public:
  FloorShadow();

  /// Removes all shadows.
  void Clear();
  /// Projects a mesh from each lamp to the floor. LightAt() changes only with the next Blur().
  void Cast(const PersonMesh& mesh, const std::vector<Eigen::Vector3f>& p_W);
  /// Softens the shadows and updates the light; once after Clear().
  void Blur();
  /// World rectangle that contains the shadow [mm]; false when there is none.
  bool Bounds(Eigen::Vector2f& low_W, Eigen::Vector2f& high_W) const;
  /// Whether any of the places may lie in the shadow.
  bool MayFallOn(std::span<const FloorPlace> places) const;
  /// Light at a place: 256 without shadow.
  int LightAt(FloorPlace place) const {
    // Interpolates between the centres of four cells.
    const int px = place.x - 128, py = place.y - 128;
    const int x = px >> 8, y = py >> 8;
    if (x < hidden_.x0 || y < hidden_.y0 || x >= hidden_.x1 || y >= hidden_.y1) return 256;
    const std::uint16_t* row = &light_[y * columns_ + x];
    if ((row[0] & row[1] & row[columns_] & row[columns_ + 1]) == 256) return 256;
    const int u = px & 255, v = py & 255;
    const int top = row[0] * (256 - u) + row[1] * u;
    const int bottom = row[columns_] * (256 - u) + row[columns_ + 1] * u;
    return (top * (256 - v) + bottom * v) >> 16;
  }

 private:
  HiddenCells hidden_;
  std::vector<std::uint16_t> light_, scratch_;
  std::vector<std::uint16_t> line_;  // A line of cells with its ends repeated.
  int columns_;
};

}  // namespace mocap::simulation
