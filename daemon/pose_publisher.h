// Poses, body, voxels and status on LCM.
#pragma once

#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>

#include "config/config.h"
#include "daemon/messages.h"
#include "daemon/pose_sink.h"
#include "daemon/status_window.h"

namespace mocap {

/// Opens a way to publish.
/// @throws SetupError  when there is none; without a multicast route it names the command that adds
///                     one.
std::unique_ptr<lcm::LCM> OpenLcm(const std::string& url);

/// Says when something that comes too often shall be sent again.
class Pacer {
 public:
  explicit Pacer(double hz);
  /// Whether it is time now; if so, the next time is a period later. Never with 0 Hz.
  bool IsDue(std::int64_t now_ns);

 private:
  std::int64_t period_ns_;
  std::int64_t next_ns_ = 0;
};

/// Publishes what the contract's table of channels says. OnSet: one thread; PublishStatus: one
/// thread, the same or another.
class PosePublisher : public PoseSink {
 public:
  /// @param lcm      borrowed for the publisher's life.
  /// @param cameras  of the studio.
  PosePublisher(lcm::LCM& lcm, const LcmConfig& config, int cameras);

  void OnSet(const TrackedSet& set) override;
  void PublishStatus(const StatusReport& report);

 private:
  lcm::LCM& lcm_;
  const std::string pose_channel_, body_channel_, voxels_channel_, status_channel_;
  const int cameras_;
  Pacer body_pacer_;
  Pacer voxels_pacer_;
  // Kept so that their memory is reused.
  pose_t pose_;
  body_t body_;
  voxels_t voxels_;
  status_t status_;
};

}  // namespace mocap
