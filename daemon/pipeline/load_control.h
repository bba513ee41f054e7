// Selects the frames that an overloaded pipeline skips.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace mocap {

/// Keeps a live pipeline close to the present by skipping whole frame sets, the same in every
/// camera, before any work is spent on them.
///
/// If each camera skipped frames on its own, the rest would be of different moments and form no
/// sets. So a single place sets the time from which frames are wanted. None are wanted while too
/// many sets are under way, or while others wait behind an old one. When there is room again, or
/// when a set is already old on completion, the next frame to be captured is wanted. The bound lies
/// halfway between two frames.
///
/// A person who enters must be found, which takes longer than many periods of fast cameras. Sets
/// may wait for that and be tracked afterwards. Repeated skipping shows that the computer is too
/// slow altogether; then the remaining sets are kept young.
class LoadControl {
 public:
  /// Limit of sets from matching to tracking. At this number, no more are wanted.
  static constexpr std::int64_t kMostUnderWay = 128;
  /// Maximum age of a set on completion, or while others wait behind it: this many periods,
  static constexpr std::int64_t kTolerancePeriods = 7;
  /// and this time, if no set was skipped lately.
  static constexpr std::int64_t kPatienceNs = 1'000'000'000;
  static constexpr std::int64_t kLatelyNs = 10'000'000'000;
  /// The least delay from capture to arrival is taken over one to two spans of this length.
  static constexpr std::int64_t kDelaySpanNs = 5'000'000'000;

  /// Call when a set has been matched.
  /// @param arrival_ns  when the last of its frames had arrived.
  void AddSet(std::int64_t capture_ns, std::int64_t arrival_ns, std::int64_t now_ns,
              std::int64_t period_ns);
  /// Sets the number of sets that have been matched but not yet tracked.
  void SetUnderWay(std::int64_t sets, std::int64_t now_ns);

  /// Forgets times after the clock was put back. Counters continue.
  void StartAnew();

  /// Frames captured before this are not wanted.
  std::int64_t wanted_from_ns() const { return wanted_from_ns_; }
  /// Sets skipped so far.
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
  std::array<std::int64_t, kMostUnderWay> captures_ns_{};  ///< Of the latest sets; a ring.
  std::int64_t sets_ = 0;
  /// Delay from capture to arrival when nothing waits: exposure, transfer, clock offset. The least
  /// of the previous and the present span, so that a clock that was set is forgotten.
  std::int64_t least_delay_ns_ = kNoDelayYet;
  std::int64_t least_of_span_ns_ = kNoDelayYet;
  std::int64_t span_begin_ns_ = kNever;
  std::int64_t skipped_ = 0;
};

}  // namespace mocap
