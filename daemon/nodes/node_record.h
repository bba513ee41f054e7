// Statistics of one node.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <mocap/node_t.hpp>
#include <mocap/silhouette_t.hpp>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "daemon/nodes/node_clock.h"
#include "daemon/pipeline/latency_recorder.h"
#include "daemon/status/node_report.h"

namespace mocap {

/// Counts events of roughly the last second.
class RecentCount {
 public:
  void Add(std::int64_t count, std::int64_t now_ns);
  std::int64_t Sum(std::int64_t now_ns) const;

 private:
  struct Slice {
    std::int64_t number = -1;
    std::int64_t count = 0;
  };
  std::array<Slice, 5> slices_;
};

/// The statistics of one node. Times are by the steady clock, except `transit`. Thread-bound.
class NodeRecord {
 public:
  /// A node that is silent for longer is considered lost.
  static constexpr std::int64_t kSilenceNs = 1'000'000'000;

  /// @param cameras  that the node should have.
  NodeRecord(std::string name, const std::vector<CameraCalibration>& cameras);

  const std::string& name() const { return report_.name; }

  /// Records a silhouette. @param transit_ns  as in NodeClock::Take.
  /// @param missed  silhouettes of the camera before this one that never arrived.
  /// @return  whether the silhouette can be used.
  bool Take(const silhouette_t& message, std::int64_t missed, std::int64_t transit_ns,
            std::int64_t now_ns);
  void Take(const node_t& message, std::int64_t transit_ns, std::int64_t now_ns);

  /// Whether it can be heard and its times can be used.
  bool IsConnected(std::int64_t now_ns) const;
  NodeReport Report(std::int64_t now_ns) const;

 private:
  bool NoteHeard(std::int64_t transit_ns, std::int64_t set_ns, std::int64_t now_ns);

  std::map<std::string, std::string> calibrations_;  ///< Each camera's as text, by name.
  const std::string host_;
  NodeReport report_;
  NodeClock clock_;
  std::int64_t heard_ns_ = 0;
  std::int64_t returned_ns_ = std::numeric_limits<std::int64_t>::min() / 2;  ///< After a silence.
  std::int64_t bytes_ = 0;
  RecentCount received_, lost_;
  LatencyHistogram transit_;
};

}  // namespace mocap
