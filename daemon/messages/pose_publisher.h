// Publishes poses, body, voxels and status on LCM.
#pragma once

#include <atomic>
#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <mocap/person_body_t.hpp>
#include <mocap/studio_t.hpp>
#include <span>
#include <string>
#include <vector>

#include "config/config.h"
#include "daemon/messages/channel_watch.h"
#include "daemon/messages/lcm_sender.h"
#include "daemon/messages/messages.h"
#include "daemon/messages/open_lcm.h"
#include "daemon/messages/status_messages.h"
#include "daemon/pipeline/pacer.h"
#include "daemon/pipeline/pose_sink.h"
#include "daemon/pipeline/tap.h"
#include "daemon/status/service_report.h"
#include "drivers/studio.h"

namespace mocap {

/// Publishes poses, bodies, voxels and the service's status, each on its channel. OnSet: one
/// thread. PublishStatus: one thread, the same or another.
class PosePublisher : public PoseSink {
 public:
  /// @param lcm      borrowed for the publisher's life.
  /// @param cameras  number in the studio.
  /// @param times    kind of capture times; present ones are published as the host's time of day.
  PosePublisher(lcm::LCM& lcm, const LcmConfig& config, int cameras,
                CaptureTimes times = CaptureTimes::kPresent);

  void OnSet(const TrackedSet& set) override;
  /// From now on, also offers to the tap what OnSet publishes; borrowed for the publisher's life.
  /// Call before the first OnSet.
  void Tap(MessageTap& tap) { tap_ = &tap; }
  void PublishStatus(const ServiceReport& report);
  /// From now on, each status is followed by a description of the studio. Call before the first
  /// PublishStatus.
  void Describe(const std::string& studio, std::span<const CameraCalibration> cameras);
  /// From now on, reports own statuses to the watch; borrowed. Call before the first PublishStatus.
  void Watch(ChannelWatch& watch) { watch_ = &watch; }
  LcmSender& sender() { return sender_; }
  /// Sets the rate of voxels from now on. Any thread.
  void SetVoxelsHz(double hz) { voxels_hz_.store(hz, std::memory_order_relaxed); }

 private:
  template <typename Message>
  void Publish(const std::string& channel, const Message& message);
  TrackedSet InTimeOfDay(const TrackedSet& set) const;
  void PublishDetails(const TrackedSet& set);
  void PublishPeople(const TrackedSet& set, bool body_is_due);

  LcmSender sender_;
  ChannelWatch* watch_ = nullptr;
  MessageTap* tap_ = nullptr;
  std::vector<std::uint8_t> bytes_;  ///< Of the outgoing message.
  std::vector<std::uint8_t> status_bytes_;
  const std::string pose_channel_, body_channel_, people_channel_, bodies_channel_,
      details_channel_, voxels_channel_, status_channel_, service_channel_, contrast_channel_,
      keypoint_senders_channel_, studio_channel_;
  const int cameras_;
  const CaptureTimes times_;
  Pacer body_pacer_;
  Pacer voxels_pacer_;
  double paced_voxels_hz_;
  std::atomic<double> voxels_hz_;
  std::vector<int> known_;  ///< Numbers of the people in the last set.
  // Kept so that their memory is reused.
  pose_t pose_;
  body_t body_;
  people_t people_;
  person_body_t person_body_;
  person_details_t details_;
  voxels_t voxels_;
  status_t status_;
  service_t service_;
  contrast_t contrast_;
  keypoint_senders_t keypoint_senders_;
  studio_t studio_;
};

}  // namespace mocap
