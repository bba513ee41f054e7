// What to tell a person who waits for messages that do not arrive.
#pragma once

#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <string>

namespace mocap {

/// Notes which daemons send on an LCM address, by the prefixes of their channels.
class Silence {
 public:
  /// @param lcm     must outlive this.
  /// @param prefix  of the channels that are waited for.
  Silence(lcm::LCM& lcm, std::string url, std::string prefix);
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
  lcm::Subscription* subscription_;
  std::map<std::string, std::int64_t> heard_ns_;  ///< Prefixes, and when each was heard last.
};

}  // namespace mocap
