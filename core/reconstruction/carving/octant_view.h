// §4: a camera's view of the eight octants of a block of voxels.
#pragma once

#include <array>
#include <cstdint>

#include "core/kernels/octants.h"
#include "core/reconstruction/carving/carving_view.h"
#include "core/reconstruction/carving/window_map.h"

namespace mocap {

/// What a camera knows about each octant, one bit per octant. Bit 0 is nearest to the origin; x
/// grows with the lowest bit, then y, then z.
struct OctantDecisions {
  std::uint8_t inside;   ///< All of it is in the silhouette.
  std::uint8_t outside;  ///< All of it is in empty pixels.
  std::uint8_t unseen;   ///< All of it is outside the picture.
  std::uint8_t unknown;  ///< All of it is in an unknown pixel; told for single pixels only.
};

/// What a camera knows about the samples of eight voxels.
using kernels::SampleDecisions;

using kernels::OctantFrames;

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
  OctantDecisions JudgeByFrame(const OctantFrames& frames, int lane, const Eigen::Vector3f& middle,
                               float spread, float half) const;

  /// Tests the samples of the eight voxels of a block in the same way.
  /// @param asked  voxels whose samples matter; others may stay undecided.
  SampleDecisions JudgeSamplesByFrame(const OctantFrames& frames, int lane,
                                      const Eigen::Vector3f& middle, float voxel_spread,
                                      float sample_spread, std::uint8_t asked) const;

 private:
  kernels::OctantCamera camera_;
};

}  // namespace mocap
