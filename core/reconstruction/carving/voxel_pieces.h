// §4: connected components of a grid.
#pragma once

#include <span>
#include <vector>

#include "core/reconstruction/carving/voxel_grid.h"

namespace mocap {

/// Connected components of a voxel grid; corners connect too. Reuses its memory.
class VoxelPieces {
 public:
  /// Consecutive voxels of one row: [begin, end) along x.
  struct Run {
    int j, k;
    int begin, end;
    int piece;
    int length() const { return end - begin; }
  };

  void Find(const VoxelGrid& grid);

  /// All runs, row by row.
  const std::vector<Run>& runs() const { return runs_; }
  /// Returns the runs of rows [first_j, last_j] of layer k.
  std::span<const Run> RunsOf(int first_j, int last_j, int k) const {
    return {runs_.data() + row_begins_[k * rows_per_layer_ + first_j],
            runs_.data() + row_begins_[k * rows_per_layer_ + last_j + 1]};
  }
  /// Number of voxels of each piece. Pieces are numbered in the order of their first voxels.
  const std::vector<int>& sizes() const { return sizes_; }

 private:
  void FindRuns(const VoxelGrid& grid);
  void Join(int row, int other_row);
  int RootOf(int run);
  void NumberPieces();

  std::vector<Run> runs_;
  int rows_per_layer_ = 0;
  std::vector<int> row_begins_;
  std::vector<int> parents_;  // For each run: another run of the same piece.
  std::vector<int> sizes_;
};

}  // namespace mocap
