// Beyond the paper: what cameras cannot tell is flesh where a body is predicted.
#pragma once

#include <span>

#include "core/motion_capture.h"
#include "core/people/posed_person.h"

namespace mocap {

/// Adds doubtful cells to flesh. Reuses its memory.
class BelievedFlesh {
 public:
  /// Returns a room's flesh with the doubtful cells that are within the bodies of people whose
  /// position is known. Valid until the next call, and as long as `room`.
  const VoxelGrid& Of(const Sighting& room, std::span<const PosedPerson> people);

 private:
  VoxelGrid flesh_;
};

}  // namespace mocap
