// Publishes pictures of people in full resolution, outside the frame path.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mocap/look_request_t.hpp>
#include <mocap/look_t.hpp>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "config/config.h"
#include "core/body/body_shape.h"
#include "core/reconstruction/camera/camera_model.h"
#include "daemon/messages/lcm_sender.h"
#include "daemon/messages/look_region.h"
#include "daemon/messages/look_wants.h"
#include "daemon/pipeline/doorbell.h"
#include "daemon/pipeline/pose_sink.h"
#include "daemon/pipeline/tap.h"
#include "drivers/pixels/jpeg_encoder.h"
#include "drivers/studio.h"

namespace mocap {

/// Where people are, in the latest set.
struct PlacedPeople {
  struct Person {
    int id = 0;
    std::vector<PosedCapsule> capsules;
  };
  std::vector<Person> people;  ///< Those who are tracked come first.
  std::size_t count = 0;       ///< How many are tracked.
  std::int64_t steady_ns = 0;
};

/// Publishes regions around the tracked people while somebody asks for them, of one camera after
/// the other. It runs in its own thread of low priority. Without askers it costs nothing.
///
/// OnSet: the pipeline's last thread. Ask: any thread.
class LookPublisher : public PoseSink {
 public:
  /// @param sender   borrowed for the publisher's life.
  /// @param cameras  those that have drivers.
  LookPublisher(LcmSender& sender, const LcmConfig& config, std::vector<CameraCalibration> cameras,
                CaptureTimes times);
  ~LookPublisher() override;

  /// The pipeline's cameras offer their pictures here.
  std::deque<FrameTap>& taps() { return taps_; }
  void OnSet(const TrackedSet& set) override;
  /// Takes a request, which may contain anything.
  void Ask(const look_request_t& request);

 private:
  void Run();
  std::optional<LookWant> Want();
  void OpenOrClose(bool is_wanted);
  void WaitUntil(std::int64_t steady_ns) const;
  void Look(const LookWant& want);
  bool TakeFrame(std::size_t camera);
  void Publish(std::size_t camera, const PlacedPeople::Person& person, const LookWant& want);

  LcmSender& sender_;
  const std::string channel_;
  const std::vector<CameraCalibration> cameras_;
  const CaptureTimes times_;
  std::deque<FrameTap> taps_;
  Tap<PlacedPeople> people_tap_;
  Doorbell bell_;         ///< Rung by requests.
  Doorbell people_bell_;  ///< Nobody waits for it.
  std::mutex wants_mutex_;
  LookWants wants_;  ///< Guarded by wants_mutex_.
  std::atomic<bool> stop_{false};
  bool is_open_ = false;
  std::size_t turn_ = 0;  ///< The camera that is next.
  PlacedPeople people_;
  // Kept so that their memory is reused.
  TappedFrame frame_;
  Image<Bgr> cut_, reduced_;
  JpegEncoder encoder_;
  look_t look_;
  std::vector<std::uint8_t> bytes_;
  std::thread thread_;
};

}  // namespace mocap
