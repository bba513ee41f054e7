// §6.2: the person's voxels as a list for labelling and fitting.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry.h"
#include "core/reconstruction/carving/voxel_grid.h"
#include "core/reconstruction/carving/voxel_pieces.h"

namespace mocap {

/// One occupied voxel.
struct Voxel {
  Vector3 center_W;
  Eigen::Vector3i cell;  ///< In the grid.
  bool surface = false;  ///< One of its six neighbours is empty.
};

/// The occupied voxels of a grid without stray islands, with their neighbourhood. Reuses its
/// memory.
class VoxelCloud {
 public:
  /// Keeps the largest connected component and every large piece near it, such as a hand cut off at
  /// the wrist.
  /// @param room  the flesh of everybody in the same block of cells. There is no surface where the
  /// person touches others.
  void Build(const VoxelGrid& grid, const VoxelGrid& room);
  /// Does so for a person who is alone.
  void Build(const VoxelGrid& grid) { Build(grid, grid); }

  /// In scan order: x, then y, then z.
  const std::vector<Voxel>& voxels() const { return voxels_; }
  int size() const { return static_cast<int>(voxels_.size()); }
  bool empty() const { return voxels_.empty(); }
  double voxel_mm() const { return voxel_mm_; }
  /// Mean of all centres; zero for an empty cloud.
  Vector3 Centroid() const;
  /// The grid's extent, in cells.
  const Eigen::Vector3i& size_cells() const { return size_; }
  double volume_litres() const { return size() * voxel_mm_ * voxel_mm_ * voxel_mm_ * 1e-6; }
  /// The block of cells that contains all voxels [mm].
  Eigen::AlignedBox3d box_W() const {
    return {origin_W_, origin_W_ + voxel_mm_ * size_.cast<double>()};
  }
  /// Index of the voxel in a cell; -1 if the cell is empty or outside.
  int IndexAt(const Eigen::Vector3i& cell) const;
  /// Index of the voxel at a point; -1 if it is empty.
  int IndexAt(const Vector3& p_W) const { return IndexAt(CellAt(p_W)); }
  /// Whether there is flesh at a point, of this person or anybody else.
  bool IsFlesh(const Vector3& p_W) const { return HoldsCell(solid_bits(), CellAt(p_W)); }
  /// Equally spaced points on a line; [cells].
  struct Places {
    Vector3 first, step;
  };
  Places PlacesAlong(const Vector3& first_W, const Vector3& step_W) const {
    return {(first_W - origin_W_) / voxel_mm_, step_W / voxel_mm_};
  }
  /// A range of them: [begin, end).
  struct Stretch {
    int begin, end;
  };
  /// Returns the range of `count` points in the block of cells around all voxels, with a small
  /// margin.
  Stretch StretchOf(const Places& places, int count) const;
  /// Finds the first point of a stretch with a voxel.
  /// @pre no point is farther from box_W() than a voxel.
  std::optional<int> FirstHeld(const Places& places, const Stretch& stretch) const;
  /// Finds the last one. @pre there is one.
  int LastHeld(const Places& places, const Stretch& stretch) const;
  /// Outward normal at a surface voxel; unit length, or zero if the body has no outside there.
  Vector3 NormalAt(const Voxel& voxel) const;
  /// Indices of the surface voxels.
  const std::vector<int>& surface() const { return surface_; }

 private:
  // The grid has a margin of empty cells, so that neighbours need no check.
  static constexpr int kMargin = 3;

  bool HoldsCell(const std::vector<std::uint64_t>& bits, const Eigen::Vector3i& cell) const {
    // A negative number becomes large as an unsigned one.
    const auto is_inside = [&](int axis) {
      return static_cast<unsigned>(cell[axis]) < static_cast<unsigned>(size_[axis]);
    };
    return is_inside(0) && is_inside(1) && is_inside(2) &&
           (bits[WordOf(cell.y(), cell.z()) + (cell.x() >> 6)] >> (cell.x() & 63) & 1) != 0;
  }
  Eigen::Vector3i CellAt(const Vector3& p_W) const {
    const Vector3 place = (p_W - origin_W_) / voxel_mm_;
    const Eigen::Vector3i towards_zero = place.cast<int>();
    return towards_zero -
           (place.array() < towards_zero.cast<double>().array()).cast<int>().matrix();
  }
  // A row of bits. An empty word follows its last word, and precedes the first row.
  std::ptrdiff_t WordOf(int j, int k) const {
    const std::ptrdiff_t rows = size_.y() + 2 * kMargin;
    return 1 + ((k + kMargin) * rows + j + kMargin) * words_per_row_;
  }
  const std::uint64_t* RowOf(int j, int k) const { return &bits_[WordOf(j, k)]; }
  // The same for everybody's flesh.
  const std::vector<std::uint64_t>& solid_bits() const { return is_alone_ ? bits_ : solid_bits_; }
  const std::uint64_t* SolidRowOf(int j, int k) const { return &solid_bits()[WordOf(j, k)]; }

  // Of kPlaces points from the i-th on, the occupied ones before `end`, as bits.
  unsigned HeldFrom(const Places& places, int i, int end) const;
  void CopyPerson(const VoxelGrid& grid);
  bool IsNearPiece(const VoxelPieces::Run& run, int piece, int reach) const;
  void AddOthers(const VoxelGrid& grid, const VoxelGrid& room);
  void ListVoxels(const VoxelGrid& grid);

  Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
  Vector3 origin_W_ = Vector3::Zero();
  double voxel_mm_ = 25;
  std::ptrdiff_t words_per_row_ = 1;
  std::vector<std::uint64_t> bits_;
  bool is_alone_ = true;
  std::vector<std::uint64_t> solid_bits_;  // Unless alone.
  std::vector<int> first_of_row_;          // Number of voxels in all earlier rows.
  std::vector<Voxel> voxels_;
  std::vector<int> surface_;
  Eigen::AlignedBox3i held_cells_;
  // Only while islands are dropped.
  VoxelPieces pieces_;
  std::vector<char> is_kept_;
};

}  // namespace mocap
