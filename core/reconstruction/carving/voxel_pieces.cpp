#include "core/reconstruction/carving/voxel_pieces.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <utility>

namespace mocap {

void VoxelPieces::Find(const VoxelGrid& grid) {
  FindRuns(grid);
  const int rows = grid.size().y();
  for (int k = 0; k < grid.size().z(); ++k) {
    for (int j = 0; j < rows; ++j) {
      const int row = k * rows + j;
      if (row_begins_[row] == row_begins_[row + 1]) continue;
      if (j > 0) Join(row, row - 1);
      if (k == 0) continue;
      for (int y = std::max(j - 1, 0); y <= std::min(j + 1, rows - 1); ++y)
        Join(row, (k - 1) * rows + y);
    }
  }
  NumberPieces();
}

void VoxelPieces::FindRuns(const VoxelGrid& grid) {
  runs_.clear();
  row_begins_.clear();
  rows_per_layer_ = grid.size().y();
  for (int k = 0; k < grid.size().z(); ++k) {
    for (int j = 0; j < grid.size().y(); ++j) {
      const std::uint64_t* const row = grid.row(j, k);
      const std::size_t first = runs_.size();
      row_begins_.push_back(static_cast<int>(first));
      for (int i = 0; i < grid.words_per_row(); ++i) {
        for (std::uint64_t bits = row[i]; bits != 0;) {
          const int shift = std::countr_zero(bits);
          const int length = std::countr_one(bits >> shift);
          const int begin = i * 64 + shift, end = begin + length;
          if (runs_.size() > first && runs_.back().end == begin)
            runs_.back().end = end;
          else
            runs_.push_back({j, k, begin, end, 0});
          if (shift + length == 64) break;
          bits &= ~std::uint64_t{0} << (shift + length);
        }
      }
    }
  }
  row_begins_.push_back(static_cast<int>(runs_.size()));
  parents_.resize(runs_.size());
  std::iota(parents_.begin(), parents_.end(), 0);
}

int VoxelPieces::RootOf(int run) {
  while (parents_[run] != run) {
    parents_[run] = parents_[parents_[run]];
    run = parents_[run];
  }
  return run;
}

void VoxelPieces::Join(int row, int other_row) {
  int other = row_begins_[other_row];
  for (int run = row_begins_[row]; run < row_begins_[row + 1]; ++run) {
    while (other < row_begins_[other_row + 1] && runs_[other].end < runs_[run].begin) ++other;
    for (int i = other; i < row_begins_[other_row + 1] && runs_[i].begin <= runs_[run].end; ++i) {
      int a = RootOf(run), b = RootOf(i);
      if (a < b) std::swap(a, b);
      parents_[a] = b;
    }
  }
}

// A root is the first run of its piece.
void VoxelPieces::NumberPieces() {
  sizes_.clear();
  for (int i = 0; i < static_cast<int>(runs_.size()); ++i) {
    const int root = RootOf(i);
    if (root == i) {
      runs_[i].piece = static_cast<int>(sizes_.size());
      sizes_.push_back(0);
    }
    runs_[i].piece = runs_[root].piece;
    sizes_[runs_[i].piece] += runs_[i].length();
  }
}

}  // namespace mocap
