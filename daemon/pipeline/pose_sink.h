// Recipients of tracked sets: the publisher, a result, a test.
#pragma once

#include <cstdint>
#include <span>

#include "core/motion_capture.h"
#include "core/people/people_capture.h"

namespace mocap {

/// One frame set at the end of the pipeline. Valid during the call only.
struct TrackedSet {
  std::int64_t frame = 0;
  std::int64_t capture_ns = 0;
  std::int64_t complete_ns = 0;  ///< Arrival of its last frame, on the timeline.
  std::uint64_t cameras = 0;     ///< Bit i: camera i was used.
  int acquisition_frames = 0;
  const CaptureResult& result;              ///< Of the person tracked for longest.
  const BodyModel& body;                    ///< The same person's.
  std::span<const PersonView> people = {};  ///< All of them.
  const VoxelGrid& grid;
  std::span<const Outline> outlines = {};          ///< One per camera of the studio.
  std::span<const Eigen::Vector3i> doubtful = {};  ///< As in CarvedSet.
  Eigen::AlignedBox3d person_box_W = {};           ///< As in CarvedSet.
};

/// Receives tracked sets in order, in the pipeline's last thread.
class PoseSink {
 public:
  virtual ~PoseSink() = default;
  virtual void OnSet(const TrackedSet& set) = 0;
};

}  // namespace mocap
