// One simulated take, tracked as the daemon tracks, beside its truth; nothing goes through a file.
#pragma once

#include "config/config.h"
#include "drivers/simulation/simulated_studio.h"
#include "tools/accuracy/disturbed_camera.h"
#include "tools/report/evaluation.h"

namespace mocap {

/// What is simulated, and what is made worse than it could be.
struct AccuracyTrial {
  SimulatedStudioOptions studio = RecordedSimulation();
  TrackerKind tracker = Config().tracker;
  std::string body = Config().body;
  double voxel_mm = Config().voxel_mm;
  /// Every camera is calibrated wrongly: turned by what moves its picture's middle by this much, in
  /// a direction of its own.
  double calibration_error_px = 0;
  double covered_share = 0;       ///< As PictureDisturbance's.
  Mishap mishap = Mishap::kNone;  ///< Of the first camera, in the middle of the take.
};

struct TrialOutcome {
  Evaluation evaluation;  ///< With truth.
  int acquisition_frames = 0;
  /// Length of the longest stretch of sets that are called tracked while their mean error is above
  /// kWrongMm.
  int longest_wrong_stretch = 0;
};

/// A pose worse than this is wrong, whatever it is a measure of.
inline constexpr double kWrongMm = 150;

/// Runs a trial. The same trial has the same outcome.
/// @throws SetupError  when the studio cannot be as it is asked for.
TrialOutcome RunTrial(const AccuracyTrial& trial);

}  // namespace mocap
