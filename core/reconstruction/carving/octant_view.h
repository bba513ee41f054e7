// §4: a camera's view of the eight octants of a block of voxels.
#pragma once

#include <array>
#include <cstdint>

#include "core/reconstruction/carving/carving_view.h"
#include "core/reconstruction/carving/window_map.h"

namespace mocap {

/// What a camera knows about each octant, one bit per octant. Bit 0 is nearest to the origin; x
/// grows with the lowest bit, then y, then z.
struct OctantDecisions {
  std::uint8_t inside;   ///< All of it is in the silhouette.
  std::uint8_t outside;  ///< All of it is outside the silhouette with its gaps closed.
  std::uint8_t unseen;   ///< All of it is outside the picture.
  std::uint8_t gap;      ///< All of it is in a gap; known for single pixels only.
};

/// What a camera knows about the samples of eight voxels, as in OctantDecisions: one byte per
/// sample, one bit per voxel.
struct SampleDecisions {
  std::uint64_t inside, outside, unseen, gap;
};

/// Moves each bit to the lowest bit of its own byte.
constexpr std::uint64_t SpreadBits(std::uint8_t bits) {
  return ((bits & 0x7fu) * 0x02040810204081u & 0x0101010101010101u) | std::uint64_t{bits & 0x80u}
                                                                          << 49;
}

/// Positions of eight points in a camera's picture, and how they change around each point.
///
/// A point at offset `o` [mm] from `middle` appears at (x, y) + (along · o) / (1 + depth · o), up
/// to `error` [px].
struct OctantFrames {
  static constexpr int kLanes = 8;
  using Lanes = std::array<float, kLanes>;

  alignas(32) std::array<Lanes, 3> middle;  ///< From the common origin [mm].
  Lanes x, y;
  std::array<Lanes, 3> along_x, along_y;  ///< [px per mm]
  std::array<Lanes, 3> depth;             ///< [1/mm]
  Lanes reach_x, reach_y;  ///< Largest extent of a cube [px per mm of half its side].
  Lanes error;
};

/// One camera of a set, prepared to test many blocks. Borrows the table and the windows.
class OctantView {
 public:
  /// Frames with a smaller error [px] serve for all smaller blocks inside.
  static constexpr float kGoodFrame_px = 0.07f;

  /// @param origin_W  origin of all positions.
  void Set(const CarvingView& view, const Vector3& origin_W, const WindowMap& windows);

  /// Tests octants by the sensor-plane table.
  /// @param middle  of the block, from the origin [mm].
  /// @param spread  from there to the centres of the octants, along each axis [mm].
  /// @param half    half the side of the cubes to test there [mm].
  /// @return the decisions; `framed` gets the octants with good frames.
  OctantDecisions Project(const Eigen::Vector3f& middle, float spread, float half,
                          OctantFrames& frames, std::uint8_t& framed) const;

  /// Tests octants by the frame of one that contains them all.
  OctantDecisions CoarsePass(const OctantFrames& frames, int lane, const Eigen::Vector3f& middle,
                             float spread, float half) const;

  /// Tests the samples of the eight voxels of a block in the same way.
  /// @param asked  voxels whose samples matter; others may stay undecided.
  SampleDecisions CoarsePassSamples(const OctantFrames& frames, int lane,
                                    const Eigen::Vector3f& middle, float voxel_spread,
                                    float sample_spread, std::uint8_t asked) const;

  struct Eye {
    std::array<std::array<float, 3>, 3> R;
    std::array<float, 3> p;
    SensorPlaneTable::Nodes table;
    WindowMap::Planes planes;
  };

 private:
  Eye eye_;
};

}  // namespace mocap
