// The steps of `mocap calibrate`, each of which is also a command of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/calibration/extrinsics.h"
#include "tools/calibration/lens_fit.h"
#include "tools/calibration/studio_check.h"

namespace mocap {

/// What a person may say about a calibration.
struct CalibrateArguments {
  std::filesystem::path footage;
  std::string board;
  std::filesystem::path out;
  std::filesystem::path report;
  std::filesystem::path intrinsics;    ///< calibration.toml with lenses to keep.
  std::filesystem::path floor;         ///< Footage of the board on the floor.
  std::filesystem::path floor_points;  ///< Three points instead.
  std::filesystem::path calibration;   ///< The one to change or check.
  std::filesystem::path config;        ///< Of live cameras, which record the footage first.
  double most_seconds = 180;           ///< Of that recording.
  std::string lens = "opencv";
  std::vector<double> pitch_mm = {0.01, 0.01};
  std::string distance;  ///< Measured with a tape: cam1:cam2:MM.
  bool set_scale = false;
  double thickness_mm = 0;
  bool still = false;
  bool keep_lenses = false;
  int most_frames = 400;
  bool json = false;
};

/// Fits every camera's lens to footage of a board; poses are left at the identity.
StudioFit CalibrateIntrinsics(const CalibrateArguments& arguments);

/// Finds the cameras' poses with lenses from a file.
StudioFit CalibrateExtrinsics(const CalibrateArguments& arguments);

/// Does it all: lenses, poses, floor and scale.
StudioFit CalibrateStudio(const CalibrateArguments& arguments);

/// Sets floor, origin and axes, and scale where it is asked for.
void SetWorld(const CalibrateArguments& arguments, StudioFit& fit);

/// Findings of CheckFit and of a distance measured with a tape.
std::vector<Finding> CheckAll(const CalibrateArguments& arguments, const StudioFit& fit);

/// The figures as a table for people, or as one JSON object.
std::string FitText(const StudioFit& fit, const std::vector<Finding>& findings);
std::string FitJson(const StudioFit& fit, const std::vector<Finding>& findings);

}  // namespace mocap
