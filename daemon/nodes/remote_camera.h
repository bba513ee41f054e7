// A camera whose driver is on another computer.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "daemon/pipeline/camera_counters.h"
#include "daemon/pipeline/doorbell.h"
#include "daemon/pipeline/silhouette_source.h"
#include "daemon/pipeline/spsc_queue.h"

namespace mocap {

/// A silhouette as received, with times on this program's timeline.
struct ReceivedSilhouette {
  std::vector<std::uint8_t> packed;
  PanTiltAngles angles;
  std::int64_t capture_ns = 0;
  std::int64_t arrival_ns = 0;
  std::int64_t segment_ns = 0;
  std::uint64_t sequence = 0;
  bool is_blind = false;
  double light = 1;
  double nudged_px = 0;
};

/// Input for one camera. The listener's thread fills it, the camera's thread empties it.
struct RemoteInbox {
  RemoteInbox(const CameraCalibration& of, std::string of_node)
      : calibration(of), node(std::move(of_node)) {}

  const CameraCalibration calibration;
  const std::string node;
  Doorbell bell;  ///< Rung for each silhouette, and otherwise a few times a second.
  SpscQueue<ReceivedSilhouette> queue{8, Overflow::kDropOldest, bell};
  /// Whether its node can be heard and its times can be used.
  std::atomic<bool> is_connected{false};
};

/// Unpacks the silhouettes in its inbox.
class RemoteCamera : public SilhouetteSource {
 public:
  /// @param inbox  borrowed for life; not shared. @param rays  maximum number per outline.
  RemoteCamera(RemoteInbox& inbox, int rays) : inbox_(inbox), rays_(rays) {}

  void Start() override {}
  void Stop() override { counters_.Enter(CameraState::kEnded); }
  Outcome Next(const std::atomic<std::int64_t>& wanted_from_ns, SegmentedFrame& frame) override;
  const CameraCalibration& calibration() const override { return inbox_.calibration; }
  Expectation expectation() const override { return counters_.expectation(); }
  std::int64_t newest_ns() const override { return counters_.newest_ns(); }
  CameraStatus Status() const override;

 private:
  bool Await();
  bool Unpack(SegmentedFrame& frame);

  RemoteInbox& inbox_;
  const int rays_;
  CameraCounters counters_;
};

}  // namespace mocap
