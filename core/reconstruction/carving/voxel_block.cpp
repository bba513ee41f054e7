#include "core/reconstruction/carving/voxel_block.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace mocap {
namespace {

// The bits of a row's word within [begin, end).
std::uint64_t BitsWithin(int word, int begin, int end) {
  const int from = std::clamp(begin - 64 * word, 0, 64);
  const int to = std::clamp(end - 64 * word, from, 64);
  const std::uint64_t below_to = to == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << to) - 1;
  return from == 64 ? 0 : below_to & (~std::uint64_t{0} << from);
}

}  // namespace

void CopyBlock(const VoxelGrid& grid, const Eigen::AlignedBox3i& cells, VoxelGrid& block) {
  if (cells.isEmpty()) {
    block.Reset(grid.first_voxel(), Eigen::Vector3i::Zero(), grid.voxel_mm());
    return;
  }
  const Eigen::Vector3i& first = cells.min();
  const Eigen::Vector3i size = cells.sizes() + Eigen::Vector3i::Ones();
  block.Reset(grid.first_voxel() + first, size, grid.voxel_mm());
  const int word = first.x() / 64, shift = first.x() % 64;
  const int last = block.words_per_row() - 1;
  for (int k = 0; k < size.z(); ++k) {
    for (int j = 0; j < size.y(); ++j) {
      const std::uint64_t* const source = grid.row(first.y() + j, first.z() + k);
      std::uint64_t* const row = block.row(j, k);
      for (int i = 0; i <= last; ++i) {
        row[i] = source[word + i] >> shift;
        if (shift > 0 && word + i + 1 < grid.words_per_row())
          row[i] |= source[word + i + 1] << (64 - shift);
      }
      row[last] &= BitsWithin(last, 0, size.x());
    }
  }
}

const VoxelGrid& VoxelsWithin(const VoxelGrid& grid, const Eigen::AlignedBox3d& box_W,
                              VoxelGrid& block) {
  const Eigen::AlignedBox3i cells = CellsWithin(grid, box_W);
  if (!cells.isEmpty() && cells.sizes() + Eigen::Vector3i::Ones() == grid.size()) return grid;
  CopyBlock(grid, cells, block);
  return block;
}

Eigen::AlignedBox3i CellsWithin(const VoxelGrid& grid, const Eigen::AlignedBox3d& box_W) {
  if (box_W.isEmpty()) return {};
  const Eigen::Array3d first = (box_W.min() / grid.voxel_mm()).array().floor();
  const Eigen::Array3d past = (box_W.max() / grid.voxel_mm()).array().ceil();
  const Eigen::AlignedBox3i cells(
      first.cast<int>().matrix() - grid.first_voxel(),
      past.cast<int>().matrix() - grid.first_voxel() - Eigen::Vector3i::Ones());
  return cells.intersection({Eigen::Vector3i(0, 0, 0), grid.size() - Eigen::Vector3i::Ones()});
}

double LitresBeside(const VoxelGrid& grid, const Eigen::AlignedBox3i& cells) {
  std::int64_t voxels = 0;
  for (int k = 0; k < grid.size().z(); ++k) {
    for (int j = 0; j < grid.size().y(); ++j) {
      const bool runs_through = !cells.isEmpty() && j >= cells.min().y() && j <= cells.max().y() &&
                                k >= cells.min().z() && k <= cells.max().z();
      const std::uint64_t* const row = grid.row(j, k);
      for (int i = 0; i < grid.words_per_row(); ++i) {
        const std::uint64_t within =
            runs_through ? BitsWithin(i, cells.min().x(), cells.max().x() + 1) : 0;
        voxels += std::popcount(row[i] & ~within);
      }
    }
  }
  const double side_mm = grid.voxel_mm();
  return static_cast<double>(voxels) * side_mm * side_mm * side_mm * 1e-6;
}

}  // namespace mocap
