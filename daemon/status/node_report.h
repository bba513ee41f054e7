// How the camera nodes of a studio do.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon/base/json_object.h"

namespace mocap {

/// One node, as the studio knows it.
struct NodeReport {
  std::string name;
  bool was_heard = false;      ///< Since the start.
  std::int64_t silent_ns = 0;  ///< How long nothing has been heard of it.
  std::string version;         ///< Of its mocapd.
  bool is_of_this_version = true;

  bool clock_agrees = true;
  std::int64_t clock_apart_ns =
      0;                        ///< How far the clock here is ahead, the network's time included.
  bool has_this_clock = false;  ///< It runs on this computer.
  std::string clock_keeper;     ///< What sets its clock; empty: nothing that is known.
  bool clock_is_kept = false;   ///< Its kernel takes the clock for synchronized.
  double clock_error_ms = 0;    ///< By which it may be off, at most, as its kernel has it.

  std::int64_t received = 0;  ///< Silhouettes.
  std::int64_t lost = 0;      ///< On the way.
  double lost_share = 0;      ///< Of those of the last second.
  double transit_p50_ms = 0;  ///< From sent to received, by the two clocks.
  double transit_p99_ms = 0;
  double bytes_per_frame = 0;              ///< In the mean since the start.
  std::vector<std::string> miscalibrated;  ///< Cameras that it has calibrated otherwise.
  std::vector<std::string> missing;        ///< Cameras that it does not have.
  std::vector<std::string> complaints;     ///< What it says itself.
};

/// All nodes of a studio.
struct NodesReport {
  std::vector<NodeReport> nodes;
  std::string stranger;  ///< Sends lately and is none of them; empty: nobody does.
};

/// Whether it has not been heard for longer than what a datagram or two take.
inline bool IsSilent(const NodeReport& node) {
  constexpr std::int64_t kSilence_ns = 1'000'000'000;
  return !node.was_heard || node.silent_ns > kSilence_ns;
}

/// A line a node, for people; empty without nodes.
std::string NodeTable(const NodesReport& report);
JsonObject NodeJson(const NodeReport& node);

}  // namespace mocap
