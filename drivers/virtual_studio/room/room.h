// The empty studio: a room with textured walls and floor, a door to a corridor, and some objects.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "core/image.h"
#include "drivers/virtual_studio/room/furniture.h"

namespace mocap::simulation {

/// Smooth noise over a plane, the same everywhere for a seed; repeats after 256 cells.
class NoiseTexture {
 public:
  explicit NoiseTexture(std::uint64_t seed);
  /// In [-1, 1]; one cell is 1 × 1.
  float At(float x, float y) const;
  /// Three octaves, in [-1, 1].
  float Rough(float x, float y) const;

 private:
  std::vector<float> cells_;
};

/// The room of room_plan.h. Immutable; reentrant.
class Room {
 public:
  /// Intersection of a ray.
  struct Hit {
    float distance = 0;                             ///< In lengths of the ray's direction vector.
    Eigen::Vector3f bgr = Eigen::Vector3f::Zero();  ///< 0..255, lit.
    bool on_floor = false;
  };

  /// @param furniture  added to the room's own objects.
  Room(std::uint64_t seed, const std::vector<Block>& furniture);

  /// Traces a ray from a point inside the room.
  Hit Cast(const Eigen::Vector3f& origin_W, const Eigen::Vector3f& direction_W) const;
  Bgr wall_color() const { return wall_; }

 private:
  struct Poster {
    int wall = 0;  // 0: -x, 1: +x, 2: -y, 3: +y.
    Eigen::Vector2f center, half;
    Eigen::Vector3f first, second;
    int pattern = 0;
    float cell_mm = 80;
  };
  struct Thing {
    Block block;
    Eigen::Vector3f center, half, color;
    float cosine, sine;
  };

  void AddPosters(std::uint64_t seed);
  void AddThings(std::uint64_t seed, const std::vector<Block>& furniture);
  Eigen::Vector3f FloorColor(const Eigen::Vector3f& p) const;
  Eigen::Vector3f WallColor(int wall, const Eigen::Vector3f& p) const;
  Eigen::Vector3f CeilingColor(const Eigen::Vector3f& p) const;
  bool CastCorridor(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                    Hit& hit) const;
  void CastThings(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, Hit& hit) const;

  NoiseTexture noise_;
  Bgr wall_;
  Eigen::Vector3f wall_colors_[4], floor_color_, rug_color_;
  Eigen::Vector2f rug_center_, rug_half_;
  std::vector<Poster> posters_;
  std::vector<Thing> things_;
};

}  // namespace mocap::simulation
