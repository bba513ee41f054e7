// Converts the daemon's messages to single poses, for streaming.
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
#include <vector>

#include "tools/results/set_details.h"
#include "tools/stream/rate_limit.h"

namespace mocap {

/// Selection and rate of poses.
struct PoseFeedOptions {
  std::string prefix = {};         ///< Of the channels' names.
  bool everybody = false;          ///< Of several people, all.
  std::optional<int> person = {};  ///< This one; otherwise the person tracked longest.
  /// Maximum number of sets per second of their own time: a log may be played at any speed.
  double most_hz = std::numeric_limits<double>::infinity();
};

/// A pose to stream. Valid during the call only.
struct StreamedPose {
  const pose_t& message;
  bool is_tracked = false;       ///< If false, only time, frame and state of the message are valid.
  const body_t* body = nullptr;  ///< Names the message's joints; null: not tracked.
  PoseRow details = {};          ///< What MOCAP_DETAILS adds.
  int person = 0;                ///< 0: from MOCAP_POSE, which has no number.
  std::string name = {};
};

/// Receives LCM messages and passes on valid ones. Tracked poses do not wait for a body: those
/// before the first one (within a second) are skipped. Single-threaded.
class PoseFeed {
 public:
  using Take = std::function<void(const StreamedPose& pose)>;

  /// @param lcm  must outlive the feed.
  PoseFeed(lcm::LCM& lcm, const PoseFeedOptions& options, Take take);

  /// When the last set came, or the feed was made, by the steady clock.
  std::int64_t heard_ns() const { return heard_ns_; }
  /// When the wanted person was last in a set, or the feed was made; if none is wanted, when a set
  /// last came.
  std::int64_t present_ns() const { return present_ns_; }
  /// Whether any pose of the wanted people came.
  bool has_heard() const { return has_heard_; }
  /// Says whom the last set that was not empty had: "last seen: person 1, person 3 (anna)". Empty
  /// if all were.
  std::string LastSeen() const;

 private:
  void OnPose(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnBody(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnPeople(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnPersonBody(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnDetails(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  bool IsDue(std::int64_t utime);
  void HandOn(const pose_t& pose, int person, const std::string& name);

  const PoseFeedOptions options_;
  const Take take_;
  RateLimit rate_;
  std::int64_t heard_ns_, present_ns_;
  bool has_heard_ = false;
  std::vector<std::string> last_seen_;
  SetDetails details_;
  std::map<int, body_t> bodies_;  ///< By person; 0: from MOCAP_BODY.
};

}  // namespace mocap
