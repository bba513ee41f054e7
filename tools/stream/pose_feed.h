// From the daemon's messages to poses, one at a time, for whoever streams them on.
#pragma once

#include <cstdint>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <limits>
#include <map>
#include <mocap/body_t.hpp>
#include <mocap/people_t.hpp>
#include <mocap/pose_t.hpp>
#include <optional>
#include <string>

#include "tools/stream/rate_limit.h"

namespace mocap {

/// Whose poses are wanted, and how often.
struct PoseFeedOptions {
  std::string prefix = {};         ///< Before the channels' names.
  bool everybody = false;          ///< Of several people, each.
  std::optional<int> person = {};  ///< This one; otherwise whoever has been followed the longest.
  double most_hz = std::numeric_limits<double>::infinity();  ///< Sets a second.
};

/// A pose on its way out. Borrowed for the call.
struct StreamedPose {
  const pose_t& message;
  bool is_tracked = false;       ///< Otherwise only time, frame and state of the message count.
  const body_t* body = nullptr;  ///< Its joints are the message's; null: not tracked.
  int person = 0;                ///< 0: of MOCAP_POSE, which has no number.
  std::string name = {};
};

/// Hears LCM and hands on what is sound. A tracked pose waits for no body: before the first one is
/// heard, within a second, tracked poses are passed over. One thread.
class PoseFeed {
 public:
  using Take = std::function<void(const StreamedPose& pose)>;

  /// @param lcm  borrowed for the feed's life.
  PoseFeed(lcm::LCM& lcm, const PoseFeedOptions& options, Take take);

  /// When a set was heard last, or the feed was made, by the steady clock.
  std::int64_t heard_ns() const { return heard_ns_; }

 private:
  void OnPose(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnBody(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnPeople(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnPersonBody(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  bool IsDue();
  void HandOn(const pose_t& pose, int person, const std::string& name);

  const PoseFeedOptions options_;
  const Take take_;
  RateLimit rate_;
  std::int64_t heard_ns_;
  std::map<int, body_t> bodies_;  ///< By person; 0: MOCAP_BODY's.
};

}  // namespace mocap
