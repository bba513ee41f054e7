// Steps of `mocap calibrate`, each also a command of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/calibration/extrinsics.h"
#include "tools/calibration/lens_fit.h"
#include "tools/calibration/studio_check.h"

namespace mocap {

/// Command-line arguments for a calibration.
struct CalibrateArguments {
  std::filesystem::path footage;
  std::string board;
  std::filesystem::path out;
  std::filesystem::path report;
  std::filesystem::path intrinsics;    ///< calibration.toml with intrinsics to keep.
  std::filesystem::path floor;         ///< Footage of the board on the floor.
  std::filesystem::path floor_points;  ///< Three points instead of such footage.
  std::filesystem::path calibration;   ///< The calibration to change or check.
  std::filesystem::path config;        ///< Config of live cameras that record the footage first.
  double most_seconds = 180;           ///< Limit of that recording.
  std::string lens = "opencv";
  std::vector<double> pitch_mm = {0.01, 0.01};
  std::string distance;  ///< Measured by tape: cam1:cam2:MM.
  bool set_scale = false;
  double thickness_mm = 0;
  bool still = false;
  bool keep_lenses = false;
  int most_frames = 400;
  bool json = false;
};

/// Checks what a command is given besides its footage, before work that takes minutes.
/// @throws SetupError  for files that cannot be read or written, a board or distance that is none.
void RequireInputs(const CalibrateArguments& arguments);

/// Fits every camera's intrinsics to footage of a board; extrinsics stay the identity.
StudioFit CalibrateIntrinsics(const CalibrateArguments& arguments);

/// Finds the cameras' extrinsics, with intrinsics from a file.
StudioFit CalibrateExtrinsics(const CalibrateArguments& arguments);

/// Does all steps: intrinsics, extrinsics, floor and scale.
StudioFit CalibrateStudio(const CalibrateArguments& arguments);

/// Sets floor, origin and axes, and the scale if requested.
void SetWorld(const CalibrateArguments& arguments, StudioFit& fit);

/// Findings of CheckFit and of a distance measured by tape.
std::vector<Finding> CheckAll(const CalibrateArguments& arguments, const StudioFit& fit);

/// The findings, one a line, and the conclusion.
std::string FindingsText(const std::vector<Finding>& findings);

/// Makes the command fail if a calibration should not be used.
/// @throws std::runtime_error  naming the file.
void RequireUsable(const std::filesystem::path& file, const std::vector<Finding>& findings);

/// Formats the figures: a table for people, or one JSON object.
std::string FitText(const StudioFit& fit, const std::vector<Finding>& findings);
std::string FitJson(const StudioFit& fit, const std::vector<Finding>& findings);

}  // namespace mocap
