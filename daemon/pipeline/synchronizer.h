// Finds the frames of the cameras that belong together.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "daemon/pipeline/period_estimator.h"

namespace mocap {

/// State of a camera that has no front.
enum class Expectation {
  kNone,      ///< It is lost or has ended: sets do without it.
  kPossible,  ///< It may deliver: sets wait for it, up to a limit.
  kCertain    ///< A frame is under way: sets wait for it.
};

/// Groups frames by capture time. The oldest unprocessed frame of each camera is its front.
///
/// The lower median of the fronts sets the reference time. Fronts more than half a period older,
/// and fronts whose set has gone, cannot join a set; the oldest of them is dropped. When there are
/// none, the fronts within half a period form the set. A later front waits for its own set, so a
/// camera may miss frames, run at half the rate or drift. Sets do without cameras that are lost,
/// have ended or are late. A late camera is not waited for again until it has delivered. Unless a
/// camera is late, decisions depend on the timestamps alone, not on when they are requested. A
/// clock that was put back restarts the synchronization.
///
/// Handles times only; pictures stay with the caller. Thread-bound. Allocates nothing after
/// construction.
class Synchronizer {
 public:
  static constexpr double kWaitForever = std::numeric_limits<double>::infinity();
  /// Larger steps back mean that the clock was set.
  static constexpr std::int64_t kClockStepNs = 1'000'000'000;

  /// @param nominal_period_ns  used until it can be estimated.
  /// @param patience_periods   how far the other cameras may be ahead of a set that still lacks a
  ///                           camera that may deliver.
  Synchronizer(int cameras, std::int64_t nominal_period_ns, double patience_periods);

  /// Gives a camera its front; it must have none. A time not later than the camera's previous one
  /// is refused and counted as late, unless the clock was put back.
  /// @param sequence  the camera's count of its frames.
  /// @return whether the front was taken.
  bool Offer(int camera, std::int64_t capture_ns, std::uint64_t sequence);
  /// Whether a frame is so much older than the camera's last one that its clock was put back.
  bool StartsAnew(int camera, std::int64_t capture_ns) const {
    const Camera& offering = cameras_[camera];
    return offering.has_last && capture_ns < offering.last_ns - kClockStepNs;
  }
  bool has_front(int camera) const { return cameras_[camera].has_front; }
  /// Drops a camera's front if it is older. @return whether it was.
  bool LetGoBefore(int camera, std::int64_t capture_ns);
  void Expect(int camera, Expectation expectation) { cameras_[camera].expectation = expectation; }
  /// Notes the newest frame that any camera has taken, even if it has not been offered yet.
  void NoteNewest(std::int64_t capture_ns);
  /// Notes the newest frame of one camera. A front from before a clock step is dropped.
  void NoteNewest(int camera, std::int64_t capture_ns);

  enum class Decision {
    kWait,   ///< The front of some camera is needed first.
    kLetGo,  ///< The front of camera() was dropped: too old for any set.
    kSet,    ///< The members form a set. Their fronts are taken.
  };
  /// Takes the next decision. Call again until kWait.
  Decision Decide();

  /// After kLetGo: whose front was dropped.
  int camera() const { return let_go_; }
  /// After kSet: for each camera whether it is a member.
  const std::vector<bool>& members() const { return members_; }
  /// After kSet: the mean of the members' times, to which their hull belongs.
  std::int64_t set_ns() const { return set_ns_; }
  /// After kSet: range of the members' times.
  std::int64_t spread_ns() const { return spread_ns_; }
  /// The estimated period: that of the fastest camera.
  std::int64_t PeriodNs() const;
  /// Fronts refused or dropped, per camera.
  std::int64_t late(int camera) const { return cameras_[camera].late; }

 private:
  /// Earlier than any frame, yet safe to subtract from.
  static constexpr std::int64_t kLongAgoNs = std::numeric_limits<std::int64_t>::min() / 2;

  struct Camera {
    bool has_front = false;
    bool given_up = false;  ///< Sets were formed without it since its last front.
    Expectation expectation = Expectation::kPossible;
    std::int64_t front_ns = 0;
    bool has_last = false;
    std::int64_t last_ns = 0;
    std::int64_t late = 0;
    PeriodEstimator period;
  };

  void StartAnew(Camera& camera, std::int64_t capture_ns);
  bool MustWait(std::int64_t reference_ns, std::int64_t period_ns) const;
  Decision LetGo(int camera);
  Decision FormSet(std::int64_t reference_ns, std::int64_t half_period_ns);

  std::vector<Camera> cameras_;
  std::vector<std::int64_t> times_;  ///< Of fronts or members, sorted.
  std::int64_t nominal_period_ns_;
  double patience_periods_;
  std::int64_t newest_ns_ = kLongAgoNs;
  int let_go_ = -1;
  std::vector<bool> members_;
  std::int64_t set_ns_ = kLongAgoNs;
  std::int64_t spread_ns_ = 0;
};

}  // namespace mocap
