// `mocap witness`: keypoints by a pose network.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

/// Adds the command, which runs the program mocap-witness instead of this one: only that one needs
/// OpenCV's networks.
void AddWitnessCommand(CLI::App& app);

}  // namespace mocap
