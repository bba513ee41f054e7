// One simulated take, tracked as in the daemon and compared with its truth, without files.
#pragma once

#include "config/config.h"
#include "daemon/pipeline/pose_sink.h"
#include "drivers/studio.h"
#include "drivers/virtual_studio/studio_options.h"
#include "tools/accuracy/disturbed_camera.h"
#include "tools/report/evaluation.h"

namespace mocap {

/// Options of the simulation and its disturbances.
struct AccuracyTrial {
  SimulatedStudioOptions studio = RecordedSimulation();
  TrackerKind tracker = Config().tracker;
  std::string body = Config().body;
  double voxel_mm = Config().voxel_mm;
  /// Calibration error: every camera is rotated in its own direction, so that the middle of its
  /// picture moves by this much.
  double calibration_error_px = 0;
  double covered_share = 0;       ///< As in PictureDisturbance.
  Mishap mishap = Mishap::kNone;  ///< Happens to the first camera, in the middle of the take.
};

struct TrialOutcome {
  Evaluation evaluation;  ///< With truth.
  int acquisition_frames = 0;
  /// Longest run of frame sets with state tracked and a mean error above kWrongMm.
  int longest_wrong_stretch = 0;
  /// Longest run of frame sets that are not tracked, after the first tracked one.
  int longest_loss = 0;
};

/// A pose with a larger error is wrong, whatever the error measures.
inline constexpr double kWrongMm = 150;

/// Runs a trial. The same trial gives the same outcome.
/// @throws SetupError  for invalid studio options.
TrialOutcome RunTrial(const AccuracyTrial& trial);

/// Runs a trial with several trackers of the same sets, the k-th of which begins with set k.
/// @param firsts  their number.
std::vector<TrialOutcome> RunTrialFrom(const AccuracyTrial& trial, int firsts);

/// Opens the trial's studio, with its disturbances.
Studio OpenTrial(const AccuracyTrial& trial);
/// Compares a result of the trial's sets with the truth.
TrialOutcome OutcomeOf(const AccuracyTrial& trial, const Result& result);

/// Tracks a studio that shows the trial's people, whatever its cameras do. @param also  gets every
/// set.
TrialOutcome TrackStudio(const AccuracyTrial& trial, Studio studio, PoseSink& also);

}  // namespace mocap
