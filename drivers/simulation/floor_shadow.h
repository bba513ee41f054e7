// The shadow that the person casts on the floor, soft because several lamps make it.
#pragma once

#include <cstdint>
#include <vector>

#include "drivers/simulation/empty_view.h"
#include "drivers/simulation/person_mesh.h"

namespace mocap::simulation {

/// Casts and draws shadows; reuses its memory. Thread-bound.
class FloorShadow {
 public:
  FloorShadow();

  /// Projects the mesh from each lamp to the floor.
  void Cast(const PersonMesh& mesh, const std::vector<Eigen::Vector3f>& p_W);
  /// True when no light is missing anywhere.
  bool empty() const { return empty_; }
  /// World rectangle that holds the shadow [mm].
  Eigen::Vector2f low_W() const;
  Eigen::Vector2f high_W() const;
  /// Share of the light that arrives at a place, 1 without shadow.
  float LightAt(FloorPlace place) const;

 private:
  void CastFrom(const Eigen::Vector3f& lamp_W, std::uint8_t bit, const PersonMesh& mesh,
                const std::vector<Eigen::Vector3f>& p_W);
  void Blur();

  std::vector<std::uint8_t> lamps_hidden_;  // A bit a lamp.
  std::vector<float> light_, scratch_;
  std::vector<Eigen::Vector2f> projected_;
  int x0_ = 0, y0_ = 0, x1_ = -1, y1_ = -1;  // Cells in use, inclusive.
  bool empty_ = true;
};

}  // namespace mocap::simulation
