#include "tools/accuracy/accuracy_trial.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "config/load_config.h"
#include "core/reconstruction/camera/camera_model.h"
#include "daemon/pipeline/pipeline.h"
#include "drivers/simulation/simulated_studio.h"
#include "drivers/virtual_studio/random.h"
#include "drivers/virtual_studio/truth.h"
#include "tools/accuracy/first_sinks.h"
#include "tools/accuracy/simulated_points.h"
#include "tools/results/result_sink.h"

namespace mocap {
namespace {

/// Rotates a camera about an axis across its line of sight, like a bump.
void Misalign(double error_px, simulation::Random& random, CameraCalibration& camera) {
  const Vector2 middle_px((camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0);
  const std::optional<Vector2> middle = NormalizedFromPixel(camera.lens, middle_px);
  const std::optional<Vector2> beside =
      NormalizedFromPixel(camera.lens, middle_px + Vector2(error_px, 0));
  if (!middle || !beside) return;
  const double direction = random.Uniform(0, 2 * std::numbers::pi);
  const Vector3 axis_C(std::cos(direction), std::sin(direction), 0);
  const RigidTransform knock{ExpRotation((*beside - *middle).norm() * axis_C), Vector3::Zero()};
  camera.X_CW = knock * camera.X_CW;
}

void Disturb(const AccuracyTrial& trial, Studio& studio) {
  simulation::Random random(simulation::Mix(trial.studio.seed, simulation::Tag("disturbance")));
  for (std::size_t i = 0; i < studio.cameras.size(); ++i) {
    StudioCamera& camera = studio.cameras[i];
    if (trial.calibration_error_px > 0) {
      Misalign(trial.calibration_error_px, random, camera.calibration);
    }
    PictureDisturbance disturbance{.covered_share = trial.covered_share, .seed = random.Bits()};
    if (i == 0) {
      disturbance.mishap = trial.mishap;
      disturbance.mishap_ns =
          trial.studio.start_ns + static_cast<std::int64_t>(trial.studio.seconds / 2 * 1e9);
    }
    camera.driver = std::make_unique<DisturbedCamera>(
        std::move(camera.driver), camera.background().front().image, disturbance);
  }
}

TakeTruth TruthOf(const SimulatedStudioOptions& options, const std::vector<PoseRow>& poses) {
  const SimulatedTruth simulated(options);
  const TruthSizes sizes = simulated.Sizes();
  TakeTruth truth;
  truth.stature_mm = sizes.stature_mm;
  for (const auto& [key, length_mm] : sizes.lengths_mm) {
    truth.lengths_mm[key.substr(0, key.size() - 3)] = length_mm;
  }
  for (const PoseRow& row : poses) {
    truth.frames.push_back({.timestamp_ns = row.timestamp_ns,
                            .points_W = TrueScoredPoints(simulated, row.timestamp_ns)});
    truth.extremities.push_back(TrueExtremitiesOf(simulated, row.timestamp_ns));
  }
  return truth;
}

int LongestWrongStretch(const Accuracy& accuracy) {
  int longest = 0, length = 0, last_pose = -1;
  for (const FrameError& frame : accuracy.frames) {
    if (frame.pose != last_pose + 1) length = 0;
    last_pose = frame.pose;
    length = frame.point_mm.mean() > kWrongMm ? length + 1 : 0;
    longest = std::max(longest, length);
  }
  return longest;
}

int LongestLoss(const std::vector<PoseRow>& poses) {
  int longest = 0, length = 0;
  bool was_tracked = false;
  for (const PoseRow& row : poses) {
    const bool is_tracked = row.state == CaptureState::kTracking;
    was_tracked |= is_tracked;
    length = was_tracked && !is_tracked ? length + 1 : 0;
    longest = std::max(longest, length);
  }
  return longest;
}

class TwoSinks : public PoseSink {
 public:
  TwoSinks(PoseSink& first, PoseSink& second) : first_(first), second_(second) {}
  void OnSet(const TrackedSet& set) override {
    first_.OnSet(set);
    second_.OnSet(set);
  }

 private:
  PoseSink& first_;
  PoseSink& second_;
};

PipelineOptions PipelineOf(const AccuracyTrial& trial) {
  return {.voxel_mm = trial.voxel_mm, .overflow = Overflow::kWait, .tracker = trial.tracker};
}

TrialOutcome OutcomeOf(const AccuracyTrial& trial, const ResultSink& sink) {
  TrialOutcome outcome = OutcomeOf(trial, sink.result());
  outcome.acquisition_frames = sink.acquisition_frames();
  return outcome;
}

}  // namespace

Studio OpenTrial(const AccuracyTrial& trial) {
  Studio studio = OpenSimulatedStudio(trial.studio);
  Disturb(trial, studio);
  return studio;
}

TrialOutcome OutcomeOf(const AccuracyTrial& trial, const Result& result) {
  TrialOutcome outcome;
  outcome.evaluation = Evaluate(result, TruthOf(trial.studio, result.poses));
  outcome.longest_loss = LongestLoss(outcome.evaluation.result.poses);
  outcome.longest_wrong_stretch = LongestWrongStretch(*outcome.evaluation.accuracy);
  return outcome;
}

TrialOutcome TrackStudio(const AccuracyTrial& trial, Studio studio, PoseSink& also) {
  ResultSink sink(KeptPeople::kFirst, false);
  TwoSinks both(sink, also);
  Pipeline pipeline(std::move(studio), PipelineOf(trial), LoadBodyTable(trial.body), both);
  pipeline.Start();
  pipeline.Join();
  return OutcomeOf(trial, sink);
}

TrialOutcome RunTrial(const AccuracyTrial& trial) { return RunTrialFrom(trial, 1).front(); }

std::vector<TrialOutcome> RunTrialFrom(const AccuracyTrial& trial, int firsts) {
  FirstSinks sinks(firsts, KeptPeople::kFirst);
  PipelineOptions options = PipelineOf(trial);
  options.other_starts = sinks.others();
  Pipeline pipeline(OpenTrial(trial), options, LoadBodyTable(trial.body), sinks.own());
  pipeline.Start();
  pipeline.Join();
  std::vector<TrialOutcome> outcomes;
  for (const ResultSink& sink : sinks.all()) outcomes.push_back(OutcomeOf(trial, sink));
  return outcomes;
}

}  // namespace mocap
