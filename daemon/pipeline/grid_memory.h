// Limits the memory that voxel grids keep while they circulate between threads.
#pragma once

#include <atomic>
#include <cstddef>

#include "core/reconstruction/carving/voxel_grid.h"

namespace mocap {

/// Lets grids keep their memory, so that nothing is allocated once all have grown, while their
/// total above the usual size is below a limit. Above it, grids release their memory after use.
/// Otherwise a momentary hull of the whole room would stay allocated in more than a hundred grids.
///
/// NoteGrowth: the thread that fills grids. Bound: the thread that has finished with them.
class GridMemory {
 public:
  /// @param usual_bytes  that each grid may always keep.
  /// @param most_bytes   that all may keep above that, together.
  GridMemory(std::size_t usual_bytes, std::size_t most_bytes)
      : usual_bytes_(usual_bytes), most_bytes_(most_bytes) {}

  /// Call after a grid was filled whose capacity was `before_bytes`.
  void NoteGrowth(std::size_t before_bytes, const VoxelGrid& grid) {
    // Filling never shrinks it.
    beyond_bytes_.fetch_add(Beyond(grid.capacity_bytes()) - Beyond(before_bytes),
                            std::memory_order_relaxed);
  }
  /// Call when nobody needs the grid's content any more.
  void Bound(VoxelGrid& grid) {
    const std::size_t beyond = Beyond(grid.capacity_bytes());
    if (beyond == 0 || beyond_bytes() <= most_bytes_) return;
    grid.Release();
    beyond_bytes_.fetch_sub(beyond, std::memory_order_relaxed);
  }
  /// Total memory of grids above the usual.
  std::size_t beyond_bytes() const { return beyond_bytes_.load(std::memory_order_relaxed); }

 private:
  std::size_t Beyond(std::size_t bytes) const {
    return bytes > usual_bytes_ ? bytes - usual_bytes_ : 0;
  }

  const std::size_t usual_bytes_, most_bytes_;
  std::atomic<std::size_t> beyond_bytes_{0};
};

}  // namespace mocap
