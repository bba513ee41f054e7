// Beyond the paper: separates people who touch, by their heads.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "core/reconstruction/carving/voxel_pieces.h"

namespace mocap {

/// Divides one connected piece of flesh among the people who stand or sit in it. Seen from above,
/// each is a summit with a valley around. A flood that falls from above joins two summits where
/// they meet, unless both are much higher than that place and have enough flesh for a person. A
/// raised arm has too little flesh, and a lying person is too low. Reuses its memory.
class StandingFlesh {
 public:
  /// @param runs          of the piece.
  /// @param grid          that contains it; the floor is at z = 0.
  /// @param least_litres  minimum for a person.
  void Divide(std::span<const VoxelPieces::Run> runs, const VoxelGrid& grid, double least_litres);

  /// Number of people, at least one.
  int count() const { return count_; }
  /// Owner of the flesh in a column of the grid, from 0. @pre  the piece has flesh there.
  int OwnerOf(int i, int j) const { return owners_[IndexOf(i, j)]; }

 private:
  struct Summit {
    int whole;  // The summit that it was joined to; itself while it is separate.
    int top;
    int voxels;
  };

  void MeasureHeights(std::span<const VoxelPieces::Run> runs);
  void Flood(const VoxelGrid& grid, double least_litres);
  int WholeOf(int summit) const;
  template <typename Visit>
  void ForEachBeside(int column, const Visit& visit) const;
  std::size_t IndexOf(int i, int j) const {
    return static_cast<std::size_t>(j - low_.y()) * size_.x() + (i - low_.x());
  }

  Eigen::Vector2i low_, size_;   // Of the columns.
  std::vector<int> tops_;        // Of each column; -1: none.
  std::vector<int> voxels_;      // Of each column.
  std::vector<int> owners_;      // Of each column: first a summit, then a person.
  std::vector<int> from_above_;  // Columns.
  std::vector<Summit> summits_;
  std::vector<int> people_;  // Of summits.
  int count_ = 0;
};

}  // namespace mocap
