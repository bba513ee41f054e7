// From names in a file to cameras that deliver.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "config/config.h"
#include "drivers/simulation/simulated_studio.h"
#include "drivers/studio.h"

namespace mocap {

/// Gives the simulated studio that the configuration names, in real time.
SimulatedStudioOptions LiveSimulation(const SourceConfig& source);

/// The cameras' calibrations, in their order.
std::vector<CameraCalibration> CalibrationsOf(const Studio& studio);

/// Opens whatever source the configuration names.
Studio OpenStudio(const Config& config);

struct TakeOptions {
  ReplayRate rate = ReplayRate::kFast;
  bool loop = false;
  bool in_memory = false;            ///< Decodes the whole take at once.
  std::vector<std::string> cameras;  ///< Empty: all.
  /// In real time, tells when the first frame of all cameras is captured, those that are not opened
  /// among them; null: when the first camera starts.
  std::function<std::int64_t()> begin_ns = nullptr;
};

/// Opens a take: its take.toml, calibration, videos, tables and background. A camera that delivered
/// nothing while the take was recorded is left out, unless it is named.
/// @throws SetupError  when a part is missing or damaged; a video that was cut off opens up to its
/// last whole frame, and one frame at least is wanted.
Studio OpenTake(const std::filesystem::path& take, const TakeOptions& options);

}  // namespace mocap
