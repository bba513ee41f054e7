// §6.2: the person's voxels as a list that labelling and fitting work on.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "core/reconstruction/voxel_grid.h"

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
  /// Takes the largest connected body and whatever large piece lies near it, such as a hand cut off
  /// at the wrist.
  void Build(const VoxelGrid& grid);

  const std::vector<Voxel>& voxels() const { return voxels_; }
  int size() const { return static_cast<int>(voxels_.size()); }
  bool empty() const { return voxels_.empty(); }
  double voxel_mm() const { return voxel_mm_; }
  /// Mean of all centres; zero of an empty cloud.
  Vector3 Centroid() const;
  /// The grid's extent, in cells.
  const Eigen::Vector3i& size_cells() const { return size_; }
  double volume_litres() const { return size() * voxel_mm_ * voxel_mm_ * voxel_mm_ * 1e-6; }
  /// The block of cells that holds all voxels [mm].
  Eigen::AlignedBox3d box_W() const {
    return {origin_W_, origin_W_ + voxel_mm_ * size_.cast<double>()};
  }
  /// Index of the voxel in a cell; -1 where the cell is empty or outside.
  int IndexAt(const Eigen::Vector3i& cell) const {
    // A negative number is a large one without its sign.
    const auto is_inside = [&](int axis) {
      return static_cast<unsigned>(cell[axis]) < static_cast<unsigned>(size_[axis]);
    };
    if (!is_inside(0) || !is_inside(1) || !is_inside(2)) return -1;
    return index_of_slot_[SlotOf(cell)];
  }
  /// Index of the voxel at a place; -1 where it is empty.
  int IndexAt(const Vector3& p_W) const;
  /// Out of the body at a surface voxel; unit length, or zero where the body has no outside.
  Vector3 NormalAt(const Voxel& voxel) const;
  /// Indices of the surface voxels.
  const std::vector<int>& surface() const { return surface_; }

 private:
  // The grid is kept with empty cells around it, so that neighbours need no check.
  static constexpr int kMargin = 3;
  std::ptrdiff_t SlotOf(const Eigen::Vector3i& cell) const {
    const auto inner = (cell.array() + kMargin).cast<std::ptrdiff_t>();
    return (inner.z() * (size_.y() + 2 * kMargin) + inner.y()) * (size_.x() + 2 * kMargin) +
           inner.x();
  }
  /// How far the slots of the cells in a cube around a cell lie from its own.
  std::vector<std::ptrdiff_t> CubeOffsets(int radius) const;
  void DropIslands();
  void FindSurface();

  Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
  Vector3 origin_W_ = Vector3::Zero();
  double voxel_mm_ = 25;
  std::vector<std::int32_t> index_of_slot_;
  std::vector<Voxel> voxels_;
  std::vector<int> surface_;
  std::vector<int> component_;
  std::vector<int> stack_;
};

}  // namespace mocap
