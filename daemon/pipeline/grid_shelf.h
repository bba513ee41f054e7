// Passes the memory of voxel grids back to the thread that fills them.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <utility>

#include "core/reconstruction/carving/voxel_grid.h"

namespace mocap {

/// Keeps the memory of a few grids while nobody uses them, so that usually nothing is allocated.
///
/// More than a hundred sets may wait between two threads, and each would keep the memory of the
/// largest hull that it ever held, though hardly any set waits for long. With the shelf, only sets
/// that wait have grids. When many wait, more grids are allocated, and freed afterwards.
///
/// Take: the thread that fills grids. Give: the thread that has finished with them.
class GridShelf {
 public:
  static constexpr std::size_t kPlaces = 8;

  /// @param usual  initial content of each place, so that its memory is allocated.
  explicit GridShelf(const VoxelGrid& usual) { grids_.fill(usual); }

  /// Gives a grid without memory some from the shelf, if there is any.
  void Take(VoxelGrid& grid) {
    const std::size_t taken = taken_.load(std::memory_order_relaxed);
    if (grid.capacity_bytes() > 0 || taken == given_.load(std::memory_order_acquire)) return;
    std::swap(grid, grids_[taken % kPlaces]);
    taken_.store(taken + 1, std::memory_order_release);
  }
  /// Takes the memory of a grid whose content nobody needs any more. Frees it if the shelf is full.
  void Give(VoxelGrid& grid) {
    const std::size_t given = given_.load(std::memory_order_relaxed);
    if (given - taken_.load(std::memory_order_acquire) < kPlaces) {
      std::swap(grid, grids_[given % kPlaces]);
      given_.store(given + 1, std::memory_order_release);
    }
    grid.Release();
  }

 private:
  std::array<VoxelGrid, kPlaces> grids_;
  std::atomic<std::size_t> taken_{0}, given_{kPlaces};
};

}  // namespace mocap
