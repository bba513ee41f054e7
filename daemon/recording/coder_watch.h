// When threads that code frames have to come forward, and why frames were lost.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "daemon/pipeline/tap.h"
#include "daemon/recording/coding_time.h"

namespace mocap {

/// A thread that codes one camera's frames, as those see it who watch it.
struct Coder {
  FrameTap* tap = nullptr;
  std::thread thread;
  std::atomic<pid_t> id{0};           ///< The kernel's; 0: it has not begun.
  std::atomic<std::int64_t> done{0};  ///< Frames that were taken out of the queue and dealt with.

  /// Frames in memory, the one that is being coded among them. @pre  the tap was opened.
  std::int64_t Waiting() const;
  /// Whether memory is short.
  bool IsHalfFull() const;
};

/// Whether one coder has fallen behind so far that it should not wait for idle time any longer.
class Urgency {
 public:
  /// Frames may wait for so long until nobody else wants the processor.
  static constexpr std::int64_t kPatienceNs = 100'000'000;
  /// A coder that has caught up stays forward for so long: what kept it back may still be there.
  static constexpr std::int64_t kCalmNs = 1'000'000'000;

  /// Takes the state of this moment; wanted some dozens of times a second.
  bool Update(std::int64_t waiting, std::int64_t done, std::int64_t now_ns);

 private:
  bool is_urgent_ = false;
  std::int64_t last_done_ = -1;
  std::int64_t behind_since_ns_ = 0;  ///< 0: nothing waits.
  std::int64_t calm_since_ns_ = 0;    ///< 0: something waits.
};

/// Looks after the coders of a recording in a thread of its own: they code when nobody else wants
/// the processor (SCHED_IDLE), and like everybody else as soon as frames have waited.
class CoderWatch {
 public:
  /// @param coders      borrowed for the watch's life; their taps are open.
  /// @param can_return  whether a thread that went behind may come forward again.
  CoderWatch(std::vector<Coder*> coders, bool can_return);
  ~CoderWatch();

  /// Why frames were lost; empty: none were.
  std::optional<LossCause> cause() const;

 private:
  struct State {
    Urgency urgency;
    bool is_forward = false;
    std::optional<ThreadTimes> times;
    bool had_work = false;
    std::int64_t dropped = 0;
  };

  void Run();
  void Look(std::int64_t now_ns, std::int64_t passed_ns);
  void Move(Coder& coder, State& state, std::int64_t now_ns) const;
  bool Account(const Coder& coder, State& state, std::int64_t passed_ns);

  const std::vector<Coder*> coders_;
  const bool can_return_;
  std::vector<State> states_;
  CodingTime time_;  ///< Since frames have waited.
  std::int64_t idle_ns_ = 0;
  mutable std::mutex mutex_;
  std::optional<LossCause> cause_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace mocap
