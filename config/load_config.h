// Reads configuration, calibration and body tables.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "config/config.h"
#include "core/body/body_model.h"
#include "core/reconstruction/camera/camera_model.h"
#include "drivers/take/calibration_file.h"

namespace mocap {

/// Reads the daemon's TOML. Relative paths are resolved against the file's folder.
/// @throws SetupError  with file, line, key, found value and what is expected; also for unknown
/// keys.
Config LoadConfig(const std::filesystem::path& file);

/// Reads calibration.toml; cameras are in the order of the file.
/// @throws SetupError  also for an invalid rotation, impossible intrinsics, or a picture without
/// size.
std::vector<CameraCalibration> LoadCalibration(const std::filesystem::path& file);
/// The same from text. @param name  used for the text in messages.
std::vector<CameraCalibration> ParseCalibration(std::string_view text, const std::string& name);

/// Reads the metadata of calibration.toml. @throws SetupError
CalibrationRecord LoadCalibrationRecord(const std::filesystem::path& file);

/// A tracker and its name for users.
struct NamedTracker {
  std::string name;
  TrackerKind kind;
  std::string body;  ///< The table that it uses by default.
};

/// All trackers, the default first.
const std::vector<NamedTracker>& Trackers();
std::vector<std::string> TrackerNames();

/// Finds a body table: one of those built in ("mikic2003", "full") or a TOML file's path.
BodyTable LoadBodyTable(const std::string& name_or_path);

}  // namespace mocap
