// Keypoints of the people in a take.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/evidence/keypoint_view.h"
#include "tools/witness/pose_network.h"

namespace mocap {

struct WitnessedTake {
  std::filesystem::path take;
  std::vector<std::string> cameras = {};  ///< Empty: all.
  std::optional<int> people = {};         ///< Without: one.
  double rate_hz = 3;                     ///< Looks at each person.
};

/// What was found, and what it took.
struct Witnessed {
  std::vector<KeypointView> views;  ///< Sorted by time, camera and person.
  std::size_t failed = 0;           ///< Looks for which the network gave no points.
  double network_s = 0;             ///< Time that the network took.
};

/// Tracks a take as `mocap track` does, and asks the network about each person who is tracked or
/// measured, through one camera after the other. The same take gives the same views.
/// @throws SetupError  for a take that cannot be tracked; std::runtime_error when interrupted.
Witnessed WitnessTake(const WitnessedTake& wanted, PoseNetwork& network);

}  // namespace mocap
