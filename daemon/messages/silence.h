// What to tell a person who waits for messages that do not arrive.
#pragma once

#include <cstdint>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <string>

#include "drivers/clock.h"

namespace mocap {

/// Notes which daemons send on an LCM address, by the prefixes of their channels.
class Silence {
 public:
  /// Who has not been heard for longer is silent.
  static constexpr std::int64_t kLimit_ns = 2'000'000'000;

  /// @param lcm     must outlive this.
  /// @param prefix  of the channels that are waited for.
  /// @param now_ns  clock.
  Silence(lcm::LCM& lcm, std::string url, std::string prefix,
          std::function<std::int64_t()> now_ns = SteadyNs);
  ~Silence();
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

  /// Explains why nothing is heard: nobody sends, others send with another prefix, or the daemon of
  /// this prefix is a node, which sends no poses.
  std::string Text() const;

 private:
  void OnMessage(const lcm::ReceiveBuffer* buffer, const std::string& channel);

  lcm::LCM& lcm_;
  const std::string url_, prefix_;
  const std::function<std::int64_t()> now_ns_;
  lcm::Subscription* subscription_;
  std::map<std::string, std::int64_t> heard_ns_;  ///< Prefixes, and when each was heard last.
};

}  // namespace mocap
