// A take's frame sets after carving, for passes that go back and forth.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/reconstruction/carving/voxel_grid.h"
#include "core/reconstruction/silhouette/outline.h"

namespace mocap {

/// What a frame set shows of everybody in the room.
struct RecordedSet {
  VoxelGrid grid;
  std::vector<Eigen::Vector3i> doubtful;  ///< Cells that no camera denies, but too few show.
  std::vector<Outline> outlines;          ///< One per camera; empty for cameras not in the set.
  Eigen::AlignedBox3d person_box_W;       ///< Bounds of a single person [mm].
  std::int64_t frame = 0;
  std::int64_t capture_ns = 0;
};

/// The sets of a take, in order of time.
class RecordedSets {
 public:
  virtual ~RecordedSets() = default;
  virtual int count() const = 0;
  virtual std::int64_t capture_ns(int set) const = 0;
  /// Reads a set; reuses the memory of `recorded`.
  virtual void Read(int set, RecordedSet& recorded) = 0;
};

/// Time between two sets [s], whichever is earlier.
inline double TimeBetween_s(const RecordedSets& sets, int a, int b) {
  const std::int64_t apart_ns = sets.capture_ns(b) - sets.capture_ns(a);
  return static_cast<double>(apart_ns < 0 ? -apart_ns : apart_ns) * 1e-9;
}

}  // namespace mocap
