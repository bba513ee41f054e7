// State that a recording's cameras share, so that they replay in step.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace mocap {

/// Clock of a replay. Thread-safe.
class ReplayClock {
 public:
  virtual ~ReplayClock() = default;
  /// Nanoseconds; never decreases.
  virtual std::int64_t NowNs() = 0;
  virtual void SleepUntil(std::int64_t time_ns) = 0;
};

/// The program's timeline.
class TimelineClock : public ReplayClock {
 public:
  std::int64_t NowNs() override;
  void SleepUntil(std::int64_t time_ns) override;
};

/// Time span of a recording, over all its cameras.
struct ReplaySpan {
  std::int64_t first_ns = 0;
  std::int64_t period_ns = 0;  ///< From one loop's first frame to the next loop's.
};

/// Common timeline of all cameras of a take.
///
/// With a clock, the recording is replayed at its own pace and its times are moved to the present.
/// The take's first frame is captured when the first camera starts, or at a given time. A camera
/// that starts later joins the current loop. Without a clock, frames keep the recording's times and
/// come as fast as they are read. Thread-safe.
class Replay {
 public:
  /// @param clock     null: as fast as possible.
  /// @param begin_ns  called when the first camera starts; returns the capture time of the first
  /// frame.
  ///                  Null: now. Only with a clock.
  Replay(const ReplaySpan& span, bool loop, std::unique_ptr<ReplayClock> clock,
         std::function<std::int64_t()> begin_ns = nullptr)
      : span_(span), loop_(loop), clock_(std::move(clock)), begin_ns_(std::move(begin_ns)) {}

  bool loops() const { return loop_; }
  /// Null if the recording is read as fast as possible.
  ReplayClock* clock() const { return clock_.get(); }

  /// Registers a camera that starts; the first one sets the timeline.
  /// @return  the offset from the recording's times in loop 0 [ns].
  std::int64_t Join();
  /// Unregisters a camera; after the last one the timeline is unset.
  void Leave();

  /// Offset of a later loop's times from loop 0 [ns].
  std::int64_t LoopOffset(std::uint64_t loop) const {
    return static_cast<std::int64_t>(loop) * span_.period_ns;
  }
  /// Number of whole loops in a duration, 0 or more.
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
