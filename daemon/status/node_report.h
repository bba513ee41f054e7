// The status of a studio's camera nodes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mocap {

/// One node, as the studio knows it.
struct NodeReport {
  std::string name;
  bool was_heard = false;      ///< Since the start.
  std::int64_t silent_ns = 0;  ///< Since its last message.
  std::string version;         ///< Of its mocapd.
  bool is_of_this_version = true;

  bool clock_agrees = true;
  std::int64_t clock_apart_ns =
      0;                        ///< How far the clock here is ahead, the network's time included.
  bool has_this_clock = false;  ///< It runs on this computer.
  std::string clock_keeper;     ///< Program that sets its clock; empty: none known.
  bool clock_is_kept = false;   ///< Its kernel considers the clock synchronized.
  double clock_error_ms = 0;    ///< Maximum error, as its kernel estimates it.

  std::int64_t received = 0;  ///< Silhouettes.
  std::int64_t lost = 0;      ///< In transit.
  double lost_share = 0;      ///< Share in the last second.
  double transit_p50_ms = 0;  ///< From sending to receiving, by the two clocks.
  double transit_p99_ms = 0;
  double bytes_per_frame = 0;              ///< Mean since the start.
  std::vector<std::string> miscalibrated;  ///< Cameras whose calibration there differs.
  std::vector<std::string> missing;        ///< Cameras that it does not have.
  std::vector<std::string> complaints;     ///< Its own diagnostics.
};

/// All nodes of a studio.
struct NodesReport {
  std::vector<NodeReport> nodes;
  std::string stranger;  ///< A recent sender that is none of them; empty: none.
};

/// Whether it has been silent for longer than the loss of a datagram or two explains.
inline bool IsSilent(const NodeReport& node) {
  constexpr std::int64_t kSilence_ns = 1'000'000'000;
  return !node.was_heard || node.silent_ns > kSilence_ns;
}

}  // namespace mocap
