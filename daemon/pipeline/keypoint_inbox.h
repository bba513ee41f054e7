// Keypoints that have arrived and wait for the tracker.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "core/evidence/keypoint_view.h"
#include "daemon/pipeline/keypoint_source.h"
#include "daemon/pipeline/keypoint_status.h"

namespace mocap {

/// Keeps what has arrived until the tracker takes it, and counts by sender. Bounded, whatever
/// comes.
///
/// TakeFor and Tell: the tracking thread. They never wait: what they cannot do at once, TakeFor
/// does at the next set, and Tell leaves out. The rest: any thread.
class KeypointInbox : public KeypointSource {
 public:
  /// How far from now a moment may be.
  static constexpr std::int64_t kMemoryNs = 1'000'000'000;
  static constexpr std::size_t kMostSenders = 8;
  /// Views of one sender that wait.
  static constexpr std::size_t kMostWaiting = 128;
  /// A sender that is silent for longer is forgotten.
  static constexpr std::int64_t kForgetNs = 60'000'000'000;

  /// Takes a view, or refuses it for its time, or because too many wait.
  /// @param now_ns          by the clock of captures. @param steady_ns  by the steady clock.
  /// @param dropped_points  that came with it and could not be used.
  /// @return  whether it was taken.
  bool Add(const std::string& sender, KeypointView view, int dropped_points, std::int64_t now_ns,
           std::int64_t steady_ns);
  /// Counts a message that is not taken. @param sender  empty: not known.
  void Refuse(const std::string& sender, KeypointRefusal reason, std::int64_t steady_ns);

  /// Leaves views of later moments for later sets.
  void TakeFor(std::int64_t capture_ns, std::vector<KeypointView>& views) override;
  void Tell(const KeypointView& view, double agreement) override;
  /// Notes how well a sender's view agrees with the pose. @param agreement  0 to 1.
  void Tell(const std::string& sender, double agreement, std::int64_t steady_ns);

  /// Moment of the last set; 0: none yet.
  std::int64_t set_ns() const { return set_ns_.load(std::memory_order_relaxed); }
  KeypointsReport Report(std::int64_t steady_ns) const;

 private:
  struct Timed {
    std::int64_t steady_ns = 0;
    double value = 0;
  };
  struct Sender {
    KeypointSender counts;
    std::int64_t heard_ns = 0;
    std::size_t waiting = 0;
    std::deque<Timed> lags_ms, agreements;  ///< Of the last seconds.
  };
  Sender* Find(const std::string& name);
  Sender* FindOrAdd(const std::string& name, std::int64_t steady_ns);
  void RemoveOld(std::int64_t now_ns);
  static void Note(std::deque<Timed>& list, std::int64_t steady_ns, double value);

  mutable std::mutex mutex_;  ///< The tracking thread tries it, but never waits.
  std::deque<Sender> senders_;
  std::deque<KeypointView> waiting_;
  std::int64_t strangers_ = 0;
  std::atomic<std::int64_t> set_ns_{0};
};

}  // namespace mocap
