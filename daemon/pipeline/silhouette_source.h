// Source of a camera's silhouettes.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>

#include "core/reconstruction/camera/camera_model.h"
#include "daemon/pipeline/camera_status.h"
#include "daemon/pipeline/segmented_frame.h"
#include "daemon/pipeline/synchronizer.h"

namespace mocap {

/// One camera, as the frame path sees it. Its driver is here, or on another computer. Start, Next
/// and Stop: one thread; the rest: any.
class SilhouetteSource {
 public:
  virtual ~SilhouetteSource() = default;

  virtual void Start() = 0;
  virtual void Stop() = 0;

  enum class Outcome { kFrame, kNothing, kEnd };
  /// Waits a moment for the next frame. A frame captured before the current `wanted_from_ns` is
  /// dropped, unless the clock was put back.
  virtual Outcome Next(const std::atomic<std::int64_t>& wanted_from_ns, SegmentedFrame& frame) = 0;

  virtual const CameraCalibration& calibration() const = 0;
  /// Whether another frame will come. Stays kCertain until the next call of Next, so that the owner
  /// of a frame has time to pass it on.
  virtual Expectation expectation() const = 0;
  /// Capture time of the newest segmented frame.
  virtual std::int64_t newest_ns() const = 0;
  /// The source's own counters.
  virtual CameraStatus Status() const = 0;
};

/// Opens the source of a camera without a driver of pictures here: it is on another computer, or
/// masks are given.
/// @param rays  maximum number per outline.
using OpenElsewhere =
    std::function<std::unique_ptr<SilhouetteSource>(const CameraCalibration& camera, int rays)>;

}  // namespace mocap
