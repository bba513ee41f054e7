// Calibrations of other programs. Ours: millimetres, world to camera; camera x right, y down, z
// forward; integers at pixel centres. What theirs mean is in the table of exchange.cpp.
//
// Readers return a file's content; only CheckForeignCameras validates it. Writers return texts;
// only ExportCameras writes them, after reading them back as the same cameras.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/calibration/foreign_camera.h"

namespace mocap {

/// Names of the readable and writable formats: "mocap", "pose2sim" ….
std::vector<std::string> ImportFormats();
std::vector<std::string> ExportFormats();

/// Reads and checks a calibration. @throws SetupError  naming file and key, what was found and what
/// was expected.
Imported ImportCameras(const std::string& format, const std::filesystem::path& in,
                       const ImportOptions& options = {});

/// Writes a calibration, after reading it back as the same cameras.
/// @throws SetupError  when the format cannot represent a camera: its lens, its head, its name.
void ExportCameras(const std::string& format, const std::filesystem::path& out,
                   const Cameras& cameras, const ImportOptions& options = {});

}  // namespace mocap
