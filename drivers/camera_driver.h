// A camera, whatever is behind it: a recording, the simulated studio, V4L2, GigE Vision.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "core/image.h"
#include "core/reconstruction/camera_model.h"

namespace mocap {

/// One picture and what is known of its exposure. The pixels are the driver's and stay valid until
/// its next Grab.
struct Frame {
  ImageView<const Bgr> image;
  std::int64_t capture_ns = 0;  ///< Middle of the exposure, since the Unix epoch.
  std::uint64_t sequence = 0;   ///< Counts what the camera took; a gap is what was lost on the way.
  PanTiltAngles angles;         ///< At the moment of exposure; zero without a head.
};

/// What became of a Grab.
enum class GrabStatus {
  kFrame,    ///< A frame was handed out.
  kTimeout,  ///< None came in time; try again.
  kTorn,     ///< A frame came damaged and was dropped; try again.
  kLost,     ///< The camera is gone; the driver tries to come back on later calls.
  kEnd       ///< There will be no more frames.
};

/// Pulls frames from one camera. Thread-bound: one thread calls Start, Grab and Stop.
class CameraDriver {
 public:
  virtual ~CameraDriver() = default;
  /// Begins to deliver. @throws SetupError when the camera cannot be used as configured.
  virtual void Start() = 0;
  /// Waits for the next frame. Weather is in the status; nothing is thrown.
  virtual GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) = 0;
  /// Ends delivery; the last frame's pixels are no longer valid.
  virtual void Stop() = 0;
};

}  // namespace mocap
