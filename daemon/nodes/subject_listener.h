// Where the people are, as the studio tells its nodes.
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

/// Tells a node's heads where those are whom the studio follows, by its MOCAP_PEOPLE.
class SubjectListener {
 public:
  /// @param lcm  of the studio.
  SubjectListener(const LcmConfig& lcm, std::shared_ptr<SubjectPosition> position);

  void Listen();
  /// Takes a message from the network, which may be anything; public for tests.
  void OnPeople(std::span<const std::uint8_t> bytes);
  /// Whether the studio was heard lately; forgets where people are when it was not.
  bool Hears();

 private:
  const LcmConfig lcm_;
  const std::shared_ptr<SubjectPosition> position_;
  std::int64_t heard_ns_ = 0;
  std::optional<LcmListener> listener_;  ///< Ends before what it tells.
};

}  // namespace mocap
