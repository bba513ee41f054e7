// One open, streaming camera, until it is lost.
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

/// Transport errors since the session began.
struct AravisCounters {
  std::uint64_t missing_packets = 0;
  std::uint64_t resend_requests = 0;
  std::uint64_t underruns = 0;  ///< Packets for which no buffer was free.
};

/// Receives a camera's packets in a fixed pool of buffers. Frames are handed out without copying.
///
/// Opening, closing, Trigger, PtpStatus and ClockAheadNs talk to the camera, and block for seconds
/// when it is gone: call them from one thread at a time, not from the frame thread. The frame
/// thread calls Pop and Push. Any thread may call the rest.
class AravisSession {
 public:
  /// Opens and starts the camera.
  /// @throws SetupError  when it is absent or cannot be used as configured.
  AravisSession(const AravisTarget& target, const CameraRequest& request,
                const AravisSettings& settings);
  ~AravisSession();
  AravisSession(const AravisSession&) = delete;
  AravisSession& operator=(const AravisSession&) = delete;

  /// Waits for the next buffer, complete or not; null if none comes in time.
  ArvBuffer* Pop(std::chrono::microseconds timeout);
  /// Returns a buffer to the pool.
  void Push(ArvBuffer* buffer) { arv_stream_push_buffer(stream_.get(), buffer); }

  /// The camera reported that this program lost control, or was unplugged.
  bool control_lost() const { return control_lost_.load(std::memory_order_relaxed); }
  /// Triggers one exposure. @return whether the camera answered.
  bool Trigger();
  /// In the camera's words, such as "Slave"; empty without PTP or an answer.
  std::string PtpStatus();
  /// Returns how far a GigE Vision camera's clock is ahead of this host's [ns], to within the time
  /// of the query; empty without an answer.
  std::optional<std::int64_t> ClockAheadNs();

  const AravisTarget& target() const { return target_; }
  const AravisAgreement& agreed() const { return agreed_; }
  /// How packets are received, and what is wrong with that.
  std::vector<std::string> StreamRemarks() const;
  AravisCounters Counters() const;
  /// Changes with everything that the camera sends.
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
