// A camera's pictures served over GigE Vision, for clients that want to be tried without cameras.
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

/// What is wrong with a served camera and its network.
struct GigeFaults {
  double lost_packets = 0;           ///< Share of them, 0 to 1.
  std::int64_t clock_offset_ns = 0;  ///< Of its clock against the host's.
  double clock_drift_ppm = 0;
  double jitter_ms = 0;    ///< Frames leave late by up to that.
  std::uint64_t seed = 1;  ///< Of the jitter.
  bool has_no_ptp_master = false;
};

struct GigeIdentity {
  std::string ip;      ///< An address of this host, the camera's own.
  std::string name;    ///< By which clients find it, up to 15 characters.
  std::string serial;  ///< The same.
  bool has_ptp = false;
};

/// Serves whatever a driver delivers, as a real camera would: stamps tell the beginning of the
/// exposure by the camera's own clock, frames leave once it is over, numbers go from 1 to 65535.
///
/// Clients may set size (cut off or filled with black), format, exposure, gain (without effect),
/// rate (up to the source's), trigger: any line fires with the source, "Software" lets its next
/// frame through, "Action1" the one that is taken when the action was asked for.
class GigeCamera {
 public:
  /// @throws SetupError  when the address is none of this host's, or taken.
  GigeCamera(const GigeIdentity& identity, std::unique_ptr<CameraDriver> source,
             const GigeFaults& faults = {});
  ~GigeCamera();
  GigeCamera(const GigeCamera&) = delete;
  GigeCamera& operator=(const GigeCamera&) = delete;

  /// What clients have written to one of its registers.
  std::uint32_t Read(std::uint32_t address) const;
  /// Some client has started it.
  bool is_streaming() const;
  /// Holds back all frames, as when the cable is pulled, while it still answers.
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
  _ArvFakeCamera* registers_ = nullptr;  ///< The server's.
  std::minstd_rand random_;
  std::atomic<bool> stopping_{false}, stalled_{false};
  std::int64_t next_wanted_ns_ = 0;
  std::mutex mutex_;  ///< For what is below.
  std::condition_variable taken_;
  bool is_waiting_ = false;  ///< The picture was not sent yet.
  bool is_flowing_ = false;  ///< Some picture was, since the client started the camera.
  Image<Bgr> picture_;
  std::vector<std::int64_t> actions_ns_;  ///< That were asked for, by its own clock.
  std::int64_t capture_ns_ = 0;
  std::uint64_t sequence_ = 0;
  std::thread thread_;
};

}  // namespace mocap
