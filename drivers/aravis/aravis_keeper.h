// Keeps a camera open, and reopens it after a loss.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "drivers/aravis/aravis_session.h"
#include "drivers/aravis/exposure_schedule.h"
#include "drivers/aravis/gige_action.h"

namespace mocap {

/// Watches a session, replaces it when the camera is lost, and talks to the camera meanwhile.
///
/// Talking to a camera that is gone blocks for seconds. Separate threads do this, and may outlive
/// their creator. The frame thread never waits for a camera.
class AravisKeeper : public std::enable_shared_from_this<AravisKeeper> {
 public:
  using Session = std::shared_ptr<AravisSession>;

  AravisKeeper(const CameraRequest& request, const AravisSettings& settings, Session session);
  /// Starts the watching thread, which keeps this object alive.
  void Start();

  /// Changes when the session is replaced.
  unsigned generation() const { return generation_.load(std::memory_order_acquire); }
  /// The session that delivers frames; null while the camera is away. The keeper closes it once it
  /// has no other user.
  Session session() const;
  /// The camera delivers nothing although it should.
  bool lost() const { return lost_.load(std::memory_order_relaxed); }
  /// The camera reports that it follows a PTP master.
  bool ptp_locked() const { return ptp_locked_.load(std::memory_order_relaxed); }
  /// Remarks on the camera's state, for people.
  std::vector<std::string> Remarks() const;

  /// Stops everything, without waiting.
  void RequestStop();
  /// Waits until the camera is released. @return whether it is.
  bool WaitClosed(std::chrono::milliseconds timeout);

 private:
  using Clock = std::chrono::steady_clock;

  void Run();
  bool IsSilent();
  void SeekGige();
  void SeekUsb();
  void FindAgain();
  void Reopen();
  void Retire();
  void Install(Session session);
  void Speak(const Session& session, unsigned generation);
  void ScheduleNext(ExposureSchedule& schedule, GigeActionSender& sender);
  void NotePtp(const std::string& status);
  void NoteTrigger(const std::string& trouble);
  void Pause(std::chrono::milliseconds pause);
  bool stopping() const { return stopping_.load(std::memory_order_relaxed); }

  const CameraRequest request_;
  const AravisSettings settings_;
  AravisTarget target_;
  std::atomic<unsigned> generation_{0};
  std::atomic<bool> lost_{false}, ptp_locked_{false}, stopping_{false};

  mutable std::mutex mutex_;  ///< Guards the members up to the keeper's own.
  std::condition_variable changed_;
  Session session_;
  int closing_ = 0;  ///< Number of sessions being closed.
  bool closed_ = false;
  std::string trouble_, ptp_status_, trigger_trouble_;

  // Used by the keeper's thread only.
  std::uint64_t signs_ = 0;
  Clock::time_point last_sign_;
  std::optional<Clock::time_point> answered_;  ///< Since when the silent camera answers probes.
  Clock::time_point next_search_, next_look_;
};

}  // namespace mocap
