// Which frames a pipeline that is behind leaves out.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace mocap {

/// Keeps a live pipeline close to the present by leaving out whole frame sets, the same ones in
/// every camera, before any work is spent on them.
///
/// Cameras that each skip what they have no time for end up with frames of different moments, which
/// make no sets. Here one place says from which moment on frames are wanted. None are while too
/// many sets are under way, or an old one has others waiting behind it; when there is room again,
/// or a set is old by the time it is complete, the next frame to be captured is the next one
/// wanted. The bound lies half-way between two frames.
///
/// Who comes in has to be found, which takes longer than many periods of fast cameras: sets may
/// wait for that and be tracked after it. A computer that is too slow altogether is told by sets
/// that are left out again and again; those that remain are then kept young.
class LoadControl {
 public:
  /// Sets from matching to tracking; at this many, no more are wanted.
  static constexpr std::int64_t kMostUnderWay = 128;
  /// How old a set may be when it is complete, or while others wait behind it: so many periods,
  static constexpr std::int64_t kTolerancePeriods = 7;
  /// and this, if no set was left out lately.
  static constexpr std::int64_t kPatienceNs = 1'000'000'000;
  static constexpr std::int64_t kLatelyNs = 10'000'000'000;
  /// The least delay between capture and arrival is that of one to two spans of this length.
  static constexpr std::int64_t kDelaySpanNs = 5'000'000'000;

  /// Takes note of a set as it is matched.
  /// @param arrival_ns  when the last of its frames had arrived.
  void AddSet(std::int64_t capture_ns, std::int64_t arrival_ns, std::int64_t now_ns,
              std::int64_t period_ns);
  /// Takes note of how many sets have been matched and not yet tracked.
  void SetUnderWay(std::int64_t sets, std::int64_t now_ns);

  /// Forgets times: the clock was put back. Counters go on.
  void StartAnew();

  /// Frames captured before this are not wanted.
  std::int64_t wanted_from_ns() const { return wanted_from_ns_; }
  /// Sets left out so far.
  std::int64_t skipped() const { return skipped_; }

 private:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

  std::int64_t ToleranceNs(std::int64_t now_ns) const;
  void LosePatience(std::int64_t now_ns);
  void WantNext(std::int64_t now_ns);
  void NoteDelay(std::int64_t delay_ns, std::int64_t now_ns);
  bool IsFull(std::int64_t sets, std::int64_t now_ns) const;

  static constexpr std::int64_t kNoDelayYet = std::numeric_limits<std::int64_t>::max();
  static constexpr std::int64_t kAll = std::numeric_limits<std::int64_t>::min();

  std::int64_t wanted_from_ns_ = kAll;
  bool has_last_ = false;
  std::int64_t last_ns_ = 0;
  std::int64_t period_ns_ = 1;
  std::int64_t impatient_until_ns_ = kAll;
  std::array<std::int64_t, kMostUnderWay> captures_ns_{};  ///< Of the latest sets, in a ring.
  std::int64_t sets_ = 0;
  /// Delay from capture to arrival when nothing waits: exposure, transfer, another clock.
  /// The least of the span before and of the present one: a clock that was set is forgotten.
  std::int64_t least_delay_ns_ = kNoDelayYet;
  std::int64_t least_of_span_ns_ = kNoDelayYet;
  std::int64_t span_begin_ns_ = kNever;
  std::int64_t skipped_ = 0;
};

}  // namespace mocap
