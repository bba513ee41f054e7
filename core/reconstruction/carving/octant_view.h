// §4: how a camera sees the eight octants of a block of voxels.
#pragma once

#include <array>
#include <cstdint>

#include "core/reconstruction/carving/carving_view.h"
#include "core/reconstruction/carving/window_map.h"

namespace mocap {

/// What a camera knows of each octant, one bit an octant: bit 0 is nearest to the origin, x grows
/// with the lowest bit, then y, then z.
struct OctantDecisions {
  std::uint8_t inside;   ///< All of it is in the silhouette.
  std::uint8_t outside;  ///< All of it is outside the silhouette with its gaps closed.
  std::uint8_t unseen;   ///< All of it is outside the picture.
  std::uint8_t gap;      ///< All of it is in a gap; told of single pixels alone.
};

/// What a camera knows of the samples of eight voxels, each as OctantDecisions: a byte a sample,
/// and in it a bit a voxel.
struct SampleDecisions {
  std::uint64_t inside, outside, unseen, gap;
};

/// The lowest bit of a byte for each bit.
constexpr std::uint64_t SpreadBits(std::uint8_t bits) {
  return ((bits & 0x7fu) * 0x02040810204081u & 0x0101010101010101u) | std::uint64_t{bits & 0x80u}
                                                                          << 49;
}

/// Where a camera sees eight places, and how that changes around each of them.
///
/// Beside a `middle` by `o` [mm] the picture is at (x, y) + (along · o) / (1 + depth · o), but for
/// `error` [px].
struct OctantFrames {
  static constexpr int kLanes = 8;
  using Lanes = std::array<float, kLanes>;

  alignas(32) std::array<Lanes, 3> middle;  ///< From the origin of all places [mm].
  Lanes x, y;
  std::array<Lanes, 3> along_x, along_y;  ///< [px per mm]
  std::array<Lanes, 3> depth;             ///< [1/mm]
  Lanes reach_x, reach_y;  ///< How far a cube reaches at most [px per mm of half its side].
  Lanes error;
};

/// One camera of a set, ready to look at many blocks. Borrows the table and the windows.
class OctantView {
 public:
  /// Frames with less error serve for all smaller blocks within [px].
  static constexpr float kGoodFrame_px = 0.07f;

  /// @param origin_W  what all places are relative to.
  void Set(const CarvingView& view, const Vector3& origin_W, const WindowMap& windows);

  /// Looks at octants by the sensor-plane table.
  /// @param middle  of the block, from the origin [mm].
  /// @param spread  from there to the middles of the octants, along each axis [mm].
  /// @param half    half the side of the cubes to judge there [mm].
  /// @return the decisions; and in `framed` the octants that got good frames.
  OctantDecisions Project(const Eigen::Vector3f& middle, float spread, float half,
                          OctantFrames& frames, std::uint8_t& framed) const;

  /// Looks at octants by the frame of one that holds them all.
  OctantDecisions CoarsePass(const OctantFrames& frames, int lane, const Eigen::Vector3f& middle,
                             float spread, float half) const;

  /// Looks at the samples of the eight voxels of a block, likewise.
  /// @param asked  the voxels whose samples matter; of others nothing may be told.
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
