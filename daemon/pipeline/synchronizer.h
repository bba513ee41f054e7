// Which frames of the cameras belong together.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "daemon/pipeline/period_estimator.h"

namespace mocap {

/// State of a camera that has no frame at its front.
enum class Expectation {
  kNone,      ///< It is lost or has ended: sets go on without it.
  kPossible,  ///< It may deliver: sets wait for it with patience.
  kCertain    ///< A frame is under way: sets wait for it.
};

/// Groups frames by capture time, from the oldest frame that each camera still offers: its front.
///
/// The fronts' lower median sets the time. Fronts more than half a period older cannot join it, nor
/// those whose set has gone: the stalest is let go. Once none is, the fronts within half a period
/// are the set; a later front waits for its own set, and so a camera may miss frames, run at half
/// the rate or drift. Cameras that are lost, have ended or are late are gone on without;
/// a late one is not waited for again before it has delivered. Unless a camera is late, decisions
/// depend on the stamps alone, not on when they are asked for. A clock that was put back begins
/// anew: what went before says nothing about its frames.
///
/// Knows times only; the pictures stay with the caller. Thread-bound; allocates nothing after
/// construction.
class Synchronizer {
 public:
  static constexpr double kWaitForever = std::numeric_limits<double>::infinity();
  /// Times that go back farther are those of a clock that was put right.
  static constexpr std::int64_t kClockStepNs = 1'000'000'000;

  /// @param nominal_period_ns  until the stamps tell better.
  /// @param patience_periods   how far the other cameras' times may run ahead of a set that still
  ///                           lacks a camera that may deliver.
  Synchronizer(int cameras, std::int64_t nominal_period_ns, double patience_periods);

  /// Gives a camera its front; it must have none. A time that is not later than the camera's last
  /// one is refused and counted late, unless it starts anew.
  /// @param sequence  the camera's count of its frames.
  /// @return whether the front was taken.
  bool Offer(int camera, std::int64_t capture_ns, std::uint64_t sequence);
  /// Whether a frame lies so far before the camera's last one that its clock was put back.
  bool StartsAnew(int camera, std::int64_t capture_ns) const {
    const Camera& offering = cameras_[camera];
    return offering.has_last && capture_ns < offering.last_ns - kClockStepNs;
  }
  bool has_front(int camera) const { return cameras_[camera].has_front; }
  /// Lets go of a camera's front if it is older. @return whether it was.
  bool LetGoBefore(int camera, std::int64_t capture_ns);
  void Expect(int camera, Expectation expectation) { cameras_[camera].expectation = expectation; }
  /// Tells of the newest frame that any camera has taken, wherever that frame is.
  void NoteNewest(std::int64_t capture_ns);
  /// Likewise, of the newest frame of one camera: a front of a time that it has left goes.
  void NoteNewest(int camera, std::int64_t capture_ns);

  enum class Verdict {
    kWait,   ///< Some camera's front is needed first.
    kLetGo,  ///< camera() has lost its front: it is too old to find a set.
    kSet,    ///< The members make a set; they have lost their fronts.
  };
  /// Takes the next decision. Call again until kWait.
  Verdict Decide();

  /// After kLetGo: whose front went.
  int camera() const { return let_go_; }
  /// After kSet: for each camera whether it is in.
  const std::vector<bool>& members() const { return members_; }
  /// After kSet: the middle one of the members' times.
  std::int64_t set_ns() const { return set_ns_; }
  /// After kSet: how far the members' times lie apart.
  std::int64_t spread_ns() const { return spread_ns_; }
  /// The period by the stamps so far: that of the fastest camera.
  std::int64_t PeriodNs() const;
  /// Fronts refused or let go, by camera.
  std::int64_t late(int camera) const { return cameras_[camera].late; }

 private:
  /// Before any frame, yet safe to subtract from.
  static constexpr std::int64_t kLongAgoNs = std::numeric_limits<std::int64_t>::min() / 2;

  struct Camera {
    bool has_front = false;
    bool given_up = false;  ///< Sets have gone on without it since its last front.
    Expectation expectation = Expectation::kPossible;
    std::int64_t front_ns = 0;
    bool has_last = false;
    std::int64_t last_ns = 0;
    std::int64_t late = 0;
    PeriodEstimator period;
  };

  void StartAnew(Camera& camera, std::int64_t capture_ns);
  bool MustWait(std::int64_t reference_ns, std::int64_t period_ns) const;
  Verdict LetGo(int camera);
  Verdict FormSet(std::int64_t reference_ns, std::int64_t half_period_ns);

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
