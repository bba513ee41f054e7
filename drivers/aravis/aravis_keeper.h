// Sees to it that a camera stays open, or comes back.
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

/// Watches a session, replaces it once the camera is lost, and speaks with the camera meanwhile.
///
/// Whatever is said to a camera that is gone blocks for seconds. So threads of its own do that,
/// and outlive whoever started them if need be: the frames' thread never waits for a camera.
class AravisKeeper : public std::enable_shared_from_this<AravisKeeper> {
 public:
  using Session = std::shared_ptr<AravisSession>;

  AravisKeeper(const CameraRequest& request, const AravisSettings& settings, Session session);
  /// Starts to watch; the thread keeps the keeper.
  void Start();

  /// Changes when another session takes over.
  unsigned generation() const { return generation_.load(std::memory_order_acquire); }
  /// The session to take frames from; null while the camera is away. It is closed by the keeper,
  /// once nobody else holds it.
  Session session() const;
  /// Nothing comes from the camera, though it should.
  bool lost() const { return lost_.load(std::memory_order_relaxed); }
  /// The camera says that it follows a PTP master.
  bool ptp_locked() const { return ptp_locked_.load(std::memory_order_relaxed); }
  /// What a person should know of the camera's state.
  std::vector<std::string> Remarks() const;

  /// Ends everything, in its own time.
  void RequestStop();
  /// Waits until the camera has been let go of. @return whether it has.
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

  mutable std::mutex mutex_;  ///< For what follows, until the keeper's own.
  std::condition_variable changed_;
  Session session_;
  int closing_ = 0;  ///< Sessions that are being closed.
  bool closed_ = false;
  std::string trouble_, ptp_status_, trigger_trouble_;

  // The keeper's own.
  std::uint64_t signs_ = 0;
  Clock::time_point last_sign_;
  std::optional<Clock::time_point> answered_;  ///< Since when the silent camera answers.
  Clock::time_point next_search_, next_look_;
};

}  // namespace mocap
