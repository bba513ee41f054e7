// Serves a camera's pictures over GigE Vision, to test clients without cameras.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "core/image.h"
#include "drivers/aravis/gobject.h"
#include "drivers/camera_driver.h"
#include "tools/gige/gige_server_thread.h"

struct _ArvBuffer;
struct _ArvGvFakeCamera;
struct _ArvFakeCamera;

namespace mocap {

/// Simulated faults of a camera and its network.
struct GigeFaults {
  double lost_packets = 0;           ///< Share of packets, 0 to 1.
  std::int64_t clock_offset_ns = 0;  ///< Its clock minus the host's.
  double clock_drift_ppm = 0;
  double jitter_ms = 0;    ///< Frames leave late by up to this.
  std::uint64_t seed = 1;  ///< Of the jitter.
  bool has_no_ptp_master = false;
};

struct GigeIdentity {
  std::string ip;      ///< An address of this host, used only by this camera.
  std::string name;    ///< Name for clients, up to 15 characters.
  std::string serial;  ///< Serial number, likewise.
  bool has_ptp = false;
};

/// Serves a driver's frames as a real camera would. Stamps are the beginning of the exposure in the
/// camera's own clock, frames leave after its end, and numbers go from 1 to 65535.
///
/// Clients may set size (cropped, or padded with black), format, exposure, gain (without effect),
/// rate (up to the source's) and trigger. Any line fires with the source. "Software" releases the
/// next frame. "Action1" releases the frame taken at the requested time.
class GigeCamera {
 public:
  /// @throws SetupError  when the address is not of this host, or in use.
  GigeCamera(const GigeIdentity& identity, std::unique_ptr<CameraDriver> source,
             const GigeFaults& faults = {});
  ~GigeCamera();
  GigeCamera(const GigeCamera&) = delete;
  GigeCamera& operator=(const GigeCamera&) = delete;

  /// Returns a register as written by clients.
  std::uint32_t Read(std::uint32_t address) const;
  /// Whether a client has started the camera.
  bool is_streaming() const;
  /// Withholds all frames, as if the cable were pulled, but still answers.
  void Stall(bool stalled) { stalled_.store(stalled, std::memory_order_relaxed); }

 private:
  static void Fill(_ArvBuffer* buffer, void* camera, unsigned exposure_us, unsigned gain,
                   unsigned pixel_format);
  void FillBuffer(_ArvBuffer* buffer, std::int64_t exposure_ns, unsigned pixel_format);
  void StartSource();
  void RunSource();
  bool IsWanted(std::int64_t capture_ns);
  void Send(const Frame& frame);
  void FollowPtp();
  void LatchTime();
  std::optional<std::uint16_t> TakeAction(std::span<const std::byte> packet);
  bool HasAction(std::int64_t time_ns);
  void Write(std::uint32_t address, std::uint32_t value);
  std::int64_t DeviceTime(std::int64_t host_ns) const;

  const GigeIdentity identity_;
  const GigeFaults faults_;
  const std::int64_t switched_on_ns_;
  std::unique_ptr<CameraDriver> source_;
  std::unique_ptr<GigeServerThread> server_thread_;  ///< Outlives the server.
  GPtr<_ArvGvFakeCamera> server_;
  _ArvFakeCamera* registers_ = nullptr;  ///< Owned by the server.
  std::minstd_rand random_;
  std::atomic<bool> stopping_{false}, stalled_{false};
  std::int64_t next_wanted_ns_ = 0;
  std::mutex mutex_;  ///< Guards the members below.
  std::condition_variable taken_;
  bool is_waiting_ = false;  ///< The picture has not been sent yet.
  bool is_flowing_ = false;  ///< A picture was sent since the client started the camera.
  Image<Bgr> picture_;
  std::vector<std::int64_t> actions_ns_;  ///< Requested actions, by the camera's clock.
  std::int64_t capture_ns_ = 0;
  std::uint64_t sequence_ = 0;
  std::thread thread_;
};

}  // namespace mocap
