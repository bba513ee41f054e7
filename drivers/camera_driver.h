// A camera, whatever is behind it: a recording, the simulated studio, V4L2, GigE Vision.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// One picture and what is known of its exposure. The pixels are the driver's and stay valid until
/// its next Grab.
struct Frame {
  ImageView<const Bgr> image;
  std::int64_t capture_ns = 0;  ///< Middle of the exposure, on the timeline (or a recording's).
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

/// What a live camera tells of itself, for people.
struct CameraFacts {
  std::string device;      ///< Where it was found: a node, an address.
  std::string bus;         ///< What it shares its bandwidth on; empty: unknown.
  double link_mbit_s = 0;  ///< What that carries; 0: unknown.
  std::string format;      ///< As the camera names it.
  double bytes_per_frame = 0;
  double fps = 0;           ///< What the camera agreed to; 0: unknown.
  std::string time_source;  ///< Where capture times come from.
  /// What is not as it was asked for or ought to be, one line each, with what to do about it.
  std::vector<std::string> remarks;
  std::string damage;  ///< How frames come to be damaged, with what to do; empty: not known.
};

/// Pulls frames from one camera. Thread-bound: one thread at a time calls it.
class CameraDriver {
 public:
  virtual ~CameraDriver() = default;
  /// Begins to deliver. @throws SetupError when the camera cannot be used as configured.
  virtual void Start() = 0;
  /// Waits for the next frame. Weather is in the status; nothing is thrown.
  virtual GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) = 0;
  /// Ends delivery; the last frame's pixels are no longer valid.
  virtual void Stop() = 0;
  /// Tells of the camera as it is since Start; called from the same thread. A driver without
  /// hardware has nothing to tell.
  virtual CameraFacts Facts() const { return {}; }
};

}  // namespace mocap
