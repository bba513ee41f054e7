// How much memory voxel grids keep while they go round between threads.
#pragma once

#include <atomic>
#include <cstddef>

#include "core/reconstruction/carving/voxel_grid.h"

namespace mocap {

/// Lets grids keep their memory, so that none is allocated once all have their size, as long as
/// what is more than usual is below a limit for all of them. Beyond it they give theirs back once
/// they were used: a hull of the whole room, for moments, would otherwise be kept by each of more
/// than a hundred grids.
///
/// NoteGrowth: the thread that fills grids; Bound: the one that is done with them.
class GridMemory {
 public:
  /// @param usual_bytes  that a grid may keep in any case.
  /// @param most_bytes   that all may keep beyond that, together.
  GridMemory(std::size_t usual_bytes, std::size_t most_bytes)
      : usual_bytes_(usual_bytes), most_bytes_(most_bytes) {}

  /// A grid that had so many bytes before has been filled.
  void NoteGrowth(std::size_t before_bytes, const VoxelGrid& grid) {
    // It never shrinks by being filled.
    beyond_bytes_.fetch_add(Beyond(grid.capacity_bytes()) - Beyond(before_bytes),
                            std::memory_order_relaxed);
  }
  /// Nobody needs what is in the grid any more.
  void Bound(VoxelGrid& grid) {
    const std::size_t beyond = Beyond(grid.capacity_bytes());
    if (beyond == 0 || beyond_bytes() <= most_bytes_) return;
    grid.Release();
    beyond_bytes_.fetch_sub(beyond, std::memory_order_relaxed);
  }
  /// Memory that grids keep beyond the usual.
  std::size_t beyond_bytes() const { return beyond_bytes_.load(std::memory_order_relaxed); }

 private:
  std::size_t Beyond(std::size_t bytes) const {
    return bytes > usual_bytes_ ? bytes - usual_bytes_ : 0;
  }

  const std::size_t usual_bytes_, most_bytes_;
  std::atomic<std::size_t> beyond_bytes_{0};
};

}  // namespace mocap
