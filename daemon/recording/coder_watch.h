// Schedules the threads that code frames, and finds out why frames were dropped.
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

/// A thread that codes one camera's frames, as its watch sees it.
struct Coder {
  FrameTap* tap = nullptr;
  std::thread thread;
  std::atomic<pid_t> id{0};           ///< The kernel's; 0: not started.
  std::atomic<std::int64_t> done{0};  ///< Frames taken out of the queue and processed.

  /// Frames in memory, including the one being coded. @pre  the tap was opened.
  std::int64_t Waiting() const;
  /// Whether memory is getting short.
  bool IsHalfFull() const;
};

/// Whether a coder is so far behind that it should no longer wait for idle time.
class Urgency {
 public:
  /// How long frames may wait for an idle processor.
  static constexpr std::int64_t kPatienceNs = 100'000'000;
  /// A coder that has caught up keeps its priority for this long: the cause may persist.
  static constexpr std::int64_t kCalmNs = 1'000'000'000;

  /// Takes the present state; call some dozens of times a second.
  bool Update(std::int64_t waiting, std::int64_t done, std::int64_t now_ns);

 private:
  bool is_urgent_ = false;
  std::int64_t last_done_ = -1;
  std::int64_t behind_since_ns_ = 0;  ///< 0: nothing waits.
  std::int64_t calm_since_ns_ = 0;    ///< 0: something waits.
};

/// Watches the coders of a recording in its own thread. They run when the processor is otherwise
/// idle (SCHED_IDLE), and with normal priority as soon as frames have waited.
class CoderWatch {
 public:
  /// @param coders      borrowed for the watch's life; their taps are open.
  /// @param can_return  whether a thread's priority may be raised again.
  CoderWatch(std::vector<Coder*> coders, bool can_return);
  ~CoderWatch();

  /// Why frames were dropped; empty: none were.
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
  CodingTime time_;  ///< Since frames have been waiting.
  std::int64_t idle_ns_ = 0;
  mutable std::mutex mutex_;
  std::optional<LossCause> cause_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace mocap
