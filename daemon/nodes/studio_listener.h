// Receives at a node what its studio says: where people are, and which cameras arrive.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/config.h"
#include "daemon/messages/lcm_listener.h"
#include "daemon/status/studio_link.h"
#include "drivers/subject_position.h"

namespace mocap {

/// Listens to the studio of a node. Passes the positions of people in MOCAP_PEOPLE to the node's
/// pan-tilt heads. Notes which of its cameras MOCAP_STATUS lists as received, and whether the
/// studio records, by MOCAP_SERVICE.
class StudioListener {
 public:
  /// @param lcm  the studio's.
  /// @param cameras  the names of the node's cameras.
  /// @param position  null: no head follows.
  StudioListener(const LcmConfig& lcm, const std::vector<std::string>& cameras,
                 std::shared_ptr<SubjectPosition> position);

  void Listen();
  /// These handle a message from the network, which may contain anything; public for tests.
  void OnPeople(std::span<const std::uint8_t> bytes);
  void OnStatus(std::span<const std::uint8_t> bytes, std::int64_t now_ns);
  void OnService(std::span<const std::uint8_t> bytes, std::int64_t now_ns);
  /// Whether the studio was heard recently; if not, forgets the positions.
  bool Hears();
  /// Any thread.
  StudioLink Link(std::int64_t now_ns) const;

 private:
  struct Camera {
    std::string name;
    std::int64_t received_ns = 0;  ///< When the studio last said so.
  };

  const LcmConfig lcm_;
  const std::shared_ptr<SubjectPosition> position_;
  const std::int64_t start_ns_;
  std::int64_t heard_people_ns_;
  mutable std::mutex mutex_;  ///< Of what follows.
  std::optional<std::int64_t> heard_ns_;
  std::int64_t recorded_ns_;  ///< When the studio last said that it records.
  std::vector<Camera> cameras_;
  std::optional<LcmListener> listener_;  ///< Ends before the members that it uses.
};

}  // namespace mocap
