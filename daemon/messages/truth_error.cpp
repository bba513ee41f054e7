#include "daemon/messages/truth_error.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "drivers/virtual_studio/truth.h"

namespace mocap {
namespace {

/// Pairs of indices: the model's point, the simulation's point.
std::vector<std::pair<int, int>> CommonPoints() {
  std::vector<std::pair<int, int>> common;
  for (int i = 0; i < kPointCount; ++i) {
    const auto truth = std::ranges::find(kSimulatedJointNames, kPointNames[i]);
    if (truth == kSimulatedJointNames.end()) continue;
    common.emplace_back(i, static_cast<int>(truth - kSimulatedJointNames.begin()));
  }
  return common;
}

}  // namespace

TruthError SimulatedTruthError(const SimulatedStudioOptions& options) {
  auto truth = std::make_shared<const SimulatedTruth>(options);
  return [truth, common = CommonPoints()](const TrackedSet& set) {
    const JointPositions joints = truth->At(set.capture_ns);
    double sum_mm = 0;
    for (const auto& [point, joint] : common) {
      sum_mm += (set.result.points_W.col(point) - joints[joint]).norm();
    }
    return sum_mm / static_cast<double>(common.size());
  };
}

}  // namespace mocap
