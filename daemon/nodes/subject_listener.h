// Receives the positions of people from the studio.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "config/config.h"
#include "daemon/messages/lcm_listener.h"
#include "drivers/subject_position.h"

namespace mocap {

/// Tells a node's pan-tilt heads where the people are, from the studio's MOCAP_PEOPLE.
class SubjectListener {
 public:
  /// @param lcm  the studio's.
  SubjectListener(const LcmConfig& lcm, std::shared_ptr<SubjectPosition> position);

  void Listen();
  /// Handles a message from the network, which may contain anything; public for tests.
  void OnPeople(std::span<const std::uint8_t> bytes);
  /// Whether the studio was heard recently; if not, forgets the positions.
  bool Hears();

 private:
  const LcmConfig lcm_;
  const std::shared_ptr<SubjectPosition> position_;
  std::int64_t heard_ns_ = 0;
  std::optional<LcmListener> listener_;  ///< Ends before the members that it uses.
};

}  // namespace mocap
