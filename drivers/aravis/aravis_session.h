// One camera that is open and streaming, from the moment it is found until it is lost.
#pragma once

#include <arv.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/aravis/aravis_agreement.h"
#include "drivers/aravis/aravis_directory.h"
#include "drivers/aravis/gobject.h"

namespace mocap {

/// What went wrong on the wire since the session began.
struct AravisCounters {
  std::uint64_t missing_packets = 0;
  std::uint64_t resend_requests = 0;
  std::uint64_t underruns = 0;  ///< Packets for which no buffer was free.
};

/// Buffers wait in a fixed pool that the camera's packets are written into; a frame is handed out
/// where it lies.
///
/// Opening, closing, Trigger, PtpStatus and ClockAheadNs speak with the camera and block for
/// seconds when it is gone: one thread at a time, and not that of the frames, which calls Pop and
/// Push. The rest: any.
class AravisSession {
 public:
  /// Opens the camera and starts it.
  /// @throws SetupError  when it cannot be used as configured, or is not there.
  AravisSession(const AravisTarget& target, const CameraRequest& request,
                const AravisSettings& settings);
  ~AravisSession();
  AravisSession(const AravisSession&) = delete;
  AravisSession& operator=(const AravisSession&) = delete;

  /// Waits for the next buffer, whole or not; null if none comes in time.
  ArvBuffer* Pop(std::chrono::microseconds timeout);
  /// Gives a buffer back.
  void Push(ArvBuffer* buffer) { arv_stream_push_buffer(stream_.get(), buffer); }

  /// The camera said that this program no longer controls it, or it was unplugged.
  bool control_lost() const { return control_lost_.load(std::memory_order_relaxed); }
  /// Starts one exposure. @return whether the camera answered.
  bool Trigger();
  /// As the camera names it, such as "Slave"; empty without PTP or an answer.
  std::string PtpStatus();
  /// How far a GigE Vision camera's clock is ahead of this host's [ns], within the time that it
  /// takes to ask; nothing without an answer.
  std::optional<std::int64_t> ClockAheadNs();

  const AravisTarget& target() const { return target_; }
  const AravisAgreement& agreed() const { return agreed_; }
  /// How packets come in, and what is not as it should be with that.
  std::vector<std::string> StreamRemarks() const;
  AravisCounters Counters() const;
  /// Changes with whatever comes from the camera.
  std::uint64_t SignsOfLife() const;

 private:
  void OpenCamera();
  void OpenStream();
  void ChoosePacketPath();
  void FillPool();
  static void OnStream(void* session, ArvStreamCallbackType type, ArvBuffer* buffer);
  static void OnControlLost(ArvDevice* device, void* session);

  enum class Realtime { kUnknown, kGranted, kRefused };

  struct Closed {};
  AravisSession(Closed, const AravisTarget& target, const CameraRequest& request,
                const AravisSettings& settings)
      : target_(target), request_(request), settings_(settings) {}

  AravisTarget target_;
  const CameraRequest request_;
  const AravisSettings settings_;
  std::atomic<bool> control_lost_{false};
  std::atomic<Realtime> realtime_{Realtime::kUnknown};
  std::vector<std::string> stream_remarks_;
  std::vector<std::uint8_t> pool_;  ///< Outlives the stream.
  GPtr<ArvCamera> camera_;
  AravisAgreement agreed_;
  GPtr<ArvStream> stream_;
};

}  // namespace mocap
