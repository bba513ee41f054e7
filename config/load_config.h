// The one reader of configuration, calibration and body tables.
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

/// Reads the daemon's TOML. Relative paths are made relative to the file.
/// @throws SetupError  naming file, line and key, what was found and what is wanted; unknown keys
/// too.
Config LoadConfig(const std::filesystem::path& file);

/// Reads calibration.toml, cameras in the order of the file.
/// @throws SetupError  also for a rotation that is none, a lens that cannot be, a picture without
/// size.
std::vector<CameraCalibration> LoadCalibration(const std::filesystem::path& file);
/// The same of its text. @param name  what messages call it.
std::vector<CameraCalibration> ParseCalibration(std::string_view text, const std::string& name);

/// Reads what calibration.toml says of itself. @throws SetupError
CalibrationRecord LoadCalibrationRecord(const std::filesystem::path& file);

/// A tracker as users call it.
struct NamedTracker {
  std::string name;
  TrackerKind kind;
  std::string body;  ///< The table that it runs on unless another is chosen.
};

/// All trackers, the default first.
const std::vector<NamedTracker>& Trackers();
std::vector<std::string> TrackerNames();

/// Finds a body table: one of those built in ("mikic2003", "full") or a TOML file's path.
BodyTable LoadBodyTable(const std::string& name_or_path);

}  // namespace mocap
