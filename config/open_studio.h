// Opens the cameras that a configuration names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "config/config.h"
#include "drivers/studio.h"
#include "drivers/virtual_studio/studio_options.h"

namespace mocap {

/// Options of the simulated studio that the configuration describes, in real time.
SimulatedStudioOptions LiveSimulation(const SourceConfig& source);

/// The cameras' calibrations, in their order.
std::vector<CameraCalibration> CalibrationsOf(const Studio& studio);

/// Opens the source that the configuration names.
Studio OpenStudio(const Config& config);

struct TakeOptions {
  ReplayRate rate = ReplayRate::kFast;
  bool loop = false;
  bool in_memory = false;                 ///< Decodes the whole take in advance.
  std::vector<std::string> cameras = {};  ///< Empty: all.
  /// In real time, gives the capture time of the first frame of all cameras, including those that
  /// are not opened. Null: the start of the first camera.
  std::function<std::int64_t()> begin_ns = nullptr;
  /// A folder of masks, CAMERA.mkv. The drivers deliver them instead of pictures, and no background
  /// is needed or given. Empty: pictures.
  std::filesystem::path masks = {};
};

/// Opens a take: its take.toml, calibration, videos, tables and background. A camera that delivered
/// nothing during the recording is omitted, unless it is named.
/// @throws SetupError  if a part is missing or damaged. A video that was cut off opens up to its
/// last complete frame; it must have at least one. If masks are wanted, every frame needs one.
Studio OpenTake(const std::filesystem::path& take, const TakeOptions& options);

}  // namespace mocap
