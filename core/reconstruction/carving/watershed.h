// Beyond the paper: separates connected flesh by its summits, as seen from above.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "core/reconstruction/carving/voxel_pieces.h"

namespace mocap {

/// What makes a hill of its own.
struct HillLimits {
  double valley_mm = 0;  ///< Least depth of the valley below its summit.
  double top_mm = 0;     ///< Least height of its summit above the floor.
  double litres = 0;     ///< Least volume.
};

/// Divides one connected piece of voxels into hills. A flood that falls from above joins two hills
/// where they meet, unless both rise far above that place and are high and large enough. Reuses its
/// memory.
class Watershed {
 public:
  /// @param runs  of the piece.
  /// @param grid  that contains it; the floor is at z = 0.
  void Divide(std::span<const VoxelPieces::Run> runs, const VoxelGrid& grid,
              const HillLimits& limits);

  /// Number of hills, at least one.
  int count() const { return count_; }
  /// Hill of a column of the grid, from 0. @pre  the piece has voxels there.
  int HillAt(int i, int j) const { return hills_of_columns_[IndexOf(i, j)]; }

 private:
  struct Hill {
    int whole;  // The hill that it was joined to; itself while it is separate.
    int top;
    int voxels;
  };

  void MeasureHeights(std::span<const VoxelPieces::Run> runs);
  void Flood(const VoxelGrid& grid, const HillLimits& limits);
  int WholeOf(int hill) const;
  template <typename Visit>
  void ForEachBeside(int column, const Visit& visit) const;
  std::size_t IndexOf(int i, int j) const {
    return static_cast<std::size_t>(j - low_.y()) * size_.x() + (i - low_.x());
  }

  Eigen::Vector2i low_, size_;         // Of the columns.
  std::vector<int> tops_;              // Of each column; -1: none.
  std::vector<int> voxels_;            // Of each column.
  std::vector<int> hills_of_columns_;  // At first with those that were joined.
  std::vector<int> from_above_;        // Columns.
  std::vector<Hill> hills_;
  std::vector<int> numbers_;  // Of hills that are separate.
  int count_ = 0;
};

}  // namespace mocap
