// §6.2: how much the flesh about a place looks like a head: a crust of surface, and little beyond
// it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/tracking/template_fit.h"
#include "core/tracking/voxel_cloud.h"

namespace mocap {

/// Scores places of one cloud.
class HeadScore {
 public:
  HeadScore(const VoxelCloud& cloud, const HeadCrust& crust);

  /// Whether places in this cell are worth a look: fine voxels are looked at in steps, as their
  /// neighbours score alike.
  bool IsOnLattice(const Eigen::Vector3i& cell) const;

  /// The share of the crust about a cell's centre that is surface, less the share of flesh around
  /// the crust; empty when that is not more than `least`.
  std::optional<double> Above(double least, const Eigen::Vector3i& cell) const;

 private:
  enum Kind : std::uint8_t { kEmpty, kInside, kSurface };
  std::ptrdiff_t SlotOf(const Eigen::Vector3i& cell) const;

  int stride_;
  int margin_;
  Eigen::Vector3i size_;
  std::vector<Kind> kinds_;  ///< Of the cells, with so many empty ones around them.
  // Where cells lie from the centre's, in kinds_.
  std::vector<std::ptrdiff_t> crust_;
  std::vector<std::ptrdiff_t> around_;
};

}  // namespace mocap
