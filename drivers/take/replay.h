// What the cameras of a recording share, so that they replay in step.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace mocap {

/// Time as a replay sees it. Thread-safe.
class ReplayClock {
 public:
  virtual ~ReplayClock() = default;
  /// Nanoseconds of a clock that never goes back.
  virtual std::int64_t NowNs() = 0;
  virtual void SleepUntil(std::int64_t time_ns) = 0;
};

/// The program's timeline.
std::unique_ptr<ReplayClock> MakeTimelineClock();

/// What a recording spans, over all its cameras.
struct ReplaySpan {
  std::int64_t first_ns = 0;
  std::int64_t period_ns = 0;  ///< From one loop's first frame to the next one's.
};

/// One time line for all cameras of a take.
///
/// With a clock the recording is replayed at its own pace, and its times are moved to the present:
/// the first frame of the take is captured when the first camera starts, or at a time that was
/// named; whoever starts later than that joins the loop then under way. Without a clock frames keep
/// the times of the recording and come as fast as they are read. Thread-safe.
class Replay {
 public:
  /// @param clock     null: as fast as possible.
  /// @param begin_ns  tells, when the first camera starts, when the first frame is captured; null:
  ///                  then. Only with a clock.
  Replay(const ReplaySpan& span, bool loop, std::unique_ptr<ReplayClock> clock,
         std::function<std::int64_t()> begin_ns = nullptr)
      : span_(span), loop_(loop), clock_(std::move(clock)), begin_ns_(std::move(begin_ns)) {}

  bool loops() const { return loop_; }
  /// Null when the recording is read as fast as possible.
  ReplayClock* clock() const { return clock_.get(); }

  /// A camera starts; the first to do so sets the time line.
  /// @return  what to add to the recording's times in loop 0 [ns].
  std::int64_t Join();
  /// A camera stops; after the last one the time line is free again.
  void Leave();

  /// What to add to the times of loop 0 in a later loop [ns].
  std::int64_t LoopOffset(std::uint64_t loop) const {
    return static_cast<std::int64_t>(loop) * span_.period_ns;
  }
  /// How many whole loops a duration has, 0 or more.
  std::uint64_t LoopsIn(std::int64_t duration_ns) const {
    return loop_ ? static_cast<std::uint64_t>(duration_ns / span_.period_ns) : 0;
  }

 private:
  const ReplaySpan span_;
  const bool loop_;
  const std::unique_ptr<ReplayClock> clock_;
  const std::function<std::int64_t()> begin_ns_;
  std::mutex mutex_;
  int cameras_ = 0;
  std::int64_t shift_ns_ = 0;
};

}  // namespace mocap
