// Interface of all cameras: recorded, simulated, V4L2, GigE Vision.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// One picture with its exposure data. The driver owns the pixels; they stay valid until its next
/// Grab.
struct Frame {
  ImageView<const Bgr> image;
  std::int64_t capture_ns = 0;  ///< Middle of the exposure, on the timeline (or the recording's).
  std::uint64_t sequence = 0;   ///< Counts the camera's frames; a gap means dropped frames.
  PanTiltAngles angles;         ///< At the moment of exposure; zero without a head.
};

/// Result of a Grab.
enum class GrabStatus {
  kFrame,    ///< A frame was handed out.
  kTimeout,  ///< None came in time; try again.
  kTorn,     ///< A damaged frame came and was dropped; try again.
  kLost,     ///< The camera is gone; later calls try to reconnect.
  kEnd       ///< There will be no more frames.
};

/// Facts about a live camera, for people.
struct CameraFacts {
  std::string device;      ///< Where it was found: device node or address.
  std::string bus;         ///< The bus that it shares with others; empty: unknown.
  double link_mbit_s = 0;  ///< Bandwidth of the bus; 0: unknown.
  std::string format;      ///< As the camera names it.
  double bytes_per_frame = 0;
  double fps = 0;           ///< As agreed with the camera; 0: unknown.
  std::string time_source;  ///< Origin of the capture times.
  /// Deviations from what was requested or recommended, one line each, with the remedy.
  std::vector<std::string> remarks;
  std::string damage;  ///< Why frames get damaged, with the remedy; empty: not known.
};

/// Pulls frames from one camera. Thread-bound: only one thread at a time may call it.
class CameraDriver {
 public:
  virtual ~CameraDriver() = default;
  /// Starts delivery. @throws SetupError when the camera cannot be used as configured.
  virtual void Start() = 0;
  /// Waits for the next frame. Reports outages in the status; throws nothing.
  virtual GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) = 0;
  /// Ends delivery. The last frame's pixels become invalid.
  virtual void Stop() = 0;
  /// Describes the camera as it is since Start; call it from the same thread. A driver without
  /// hardware returns empty facts.
  virtual CameraFacts Facts() const { return {}; }
};

}  // namespace mocap
