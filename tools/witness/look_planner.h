// Plans a witness's looks at the people of a take while it is tracked.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/body/posed_body.h"
#include "daemon/pipeline/pose_sink.h"
#include "drivers/take/take_table.h"
#include "tools/witness/look_schedule.h"
#include "tools/witness/picture_region.h"

namespace mocap {

/// A camera of a take, and when it took its pictures.
struct TimedCamera {
  CameraCalibration calibration;
  TakeTable table;
};

/// The cameras of a take in the order of `calibrations`.
/// @throws SetupError  as ReadTakeTable.
std::vector<TimedCamera> TimedCamerasOf(const std::filesystem::path& take,
                                        const std::vector<CameraCalibration>& calibrations);

/// A picture to ask the network about.
struct Look {
  int camera = 0;
  std::int64_t capture_ns = 0;  ///< Of the picture.
  int person = 0;
  PictureRegion box;  ///< Around the person.
};

/// Chooses pictures as sets are tracked. People count once their body is being measured.
class LookPlanner : public PoseSink {
 public:
  LookPlanner(std::vector<TimedCamera> cameras, double fps, double rate_hz);

  void OnSet(const TrackedSet& set) override;
  /// In the order of the sets.
  const std::vector<Look>& looks() const { return looks_; }

 private:
  void Plan(const TrackedSet& set, int person, const CaptureResult& captured,
            const BodyModel& body);

  const std::vector<TimedCamera> cameras_;
  const std::int64_t tolerance_ns_;
  LookSchedule schedule_;
  PosedBody posed_;
  std::vector<Look> looks_;
};

}  // namespace mocap
