// Keypoints of the people whom a running mocapd sees.
#pragma once

#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <mocap/look_request_t.hpp>
#include <mocap/look_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "daemon/messages/lcm_sender.h"
#include "drivers/pixels/pixel_format.h"
#include "tools/witness/pose_network.h"
#include "tools/witness/witness_pace.h"

namespace mocap {

struct LiveWitnessOptions {
  std::string url;
  std::string prefix = {};  ///< Of the channels.
  double rate_hz = 3;       ///< Looks at each person.
  double share = 1;         ///< Of one processor's time, at most; above 0.
};

/// What it did so far.
struct LiveWitnessCount {
  std::int64_t looks = 0;
  std::int64_t failed = 0;   ///< Looks for which the network gave no points.
  std::int64_t damaged = 0;  ///< Messages that are no pictures.
  std::int64_t cpu_ns = 0;   ///< Processor time of the looks.
};

/// Asks mocapd for pictures of people, asks the network about the newest of each person, and sends
/// what it finds. Thread-bound.
class LiveWitness {
 public:
  /// Subscribes. @param lcm, network  borrowed for the witness's life.
  LiveWitness(lcm::LCM& lcm, const LiveWitnessOptions& options, PoseNetwork& network);
  ~LiveWitness();
  LiveWitness(const LiveWitness&) = delete;
  LiveWitness& operator=(const LiveWitness&) = delete;

  /// Renews the request when it is time, and looks at one person who waits. To be called after
  /// the messages that have come were handled.
  /// @param now_ns  by a clock that never steps.
  void Work(std::int64_t now_ns);
  /// Asks for no more pictures.
  void End();

  const LiveWitnessCount& count() const { return count_; }
  /// When mocapd was last heard; the first call of Work counts as such.
  std::int64_t heard_ns() const { return heard_ns_; }
  /// How many people pictures show.
  std::size_t people() const { return people_.size(); }

 private:
  struct Person {
    std::optional<look_t> waiting = {};  ///< The newest picture.
    std::int64_t came_ns = 0;
    std::int64_t looked_ns = 0;  ///< The last look began then.
  };

  void OnLook(const lcm::ReceiveBuffer* buffer, const std::string&);
  void OnDetails(const lcm::ReceiveBuffer* buffer, const std::string&);
  void OnStatus(const lcm::ReceiveBuffer* buffer, const std::string&);
  void ForgetLate();
  void Ask(double rate_hz);
  Person* NextPerson();
  void Look(const look_t& look);
  bool Decode(const look_t& look);

  lcm::LCM& lcm_;
  PoseNetwork& network_;
  const std::string prefix_;
  LcmSender sender_;
  WitnessPace pace_;
  std::vector<lcm::Subscription*> subscriptions_;
  std::map<std::int32_t, Person> people_;
  LiveWitnessCount count_;
  std::int64_t now_ns_ = 0, heard_ns_ = 0, asked_ns_ = 0;
  bool has_heard_ = true, has_asked_ = false;
  bool was_in_doubt_ = false;  ///< Since the last request.
  PixelConverter converter_;
  Image<Bgr> picture_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace mocap
