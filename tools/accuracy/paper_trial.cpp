#include "tools/accuracy/paper_trial.h"

#include <cstddef>
#include <utility>

#include "config/config.h"
#include "config/load_config.h"
#include "core/mikic2003/mikic_capture.h"
#include "daemon/pipeline/pipeline.h"
#include "drivers/simulation/simulated_studio.h"
#include "drivers/virtual_studio/truth.h"
#include "tools/accuracy/paper_stages.h"
#include "tools/accuracy/simulated_points.h"

namespace mocap {
namespace {

constexpr const char* kPaperBody = "mikic2003";
// Acquisition has this time before a person who is not tracked counts as lost.
constexpr std::int64_t kAcquiredWithinNs = 1'000'000'000;

using Frames = std::vector<const CarvedTake::Frame*>;

// In a simulated studio, all flesh is the person's.
class FleshKeeper : public PoseSink {
 public:
  void OnSet(const TrackedSet& set) override {
    frames.push_back({.capture_ns = set.capture_ns, .flesh = set.grid});
  }

  std::vector<CarvedTake::Frame> frames;
};

Frames EachOf(const CarvedTake& take, int step) {
  Frames frames;
  for (std::size_t i = 0; i < take.frames.size(); i += step) frames.push_back(&take.frames[i]);
  return frames;
}

std::vector<ScoredFrame> FollowAsPublished(const Frames& frames) {
  mikic2003::MikicCapture capture(LoadBodyTable(kPaperBody));
  std::vector<ScoredFrame> followed;
  for (const CarvedTake::Frame* frame : frames) {
    const CaptureResult& result = capture.Update({frame->flesh, {}}, frame->capture_ns, nullptr);
    followed.push_back({.timestamp_ns = frame->capture_ns,
                        .tracked = result.state == CaptureState::kTracking,
                        .points_W = ScoredPointsOf(result.points_W)});
  }
  return followed;
}

// A person who was forgotten gets a true start again.
std::vector<ScoredFrame> FollowFromTruth(const Frames& frames, double stature_mm,
                                         bool has_true_parts) {
  const BodyTable table = LoadBodyTable(kPaperBody);
  PaperStages stages;
  std::vector<ScoredFrame> followed;
  std::int64_t last_ns = frames.front()->capture_ns;
  for (const CarvedTake::Frame* frame : frames) {
    const TrueSubject subject{stature_mm, frame->truth_W};
    if (!stages.has_started()) {
      const BodyModel body(table, TrueSizes(subject));
      stages.Start(body, TrueStart(body, subject));
    } else {
      const TrueParts parts(subject);
      stages.Follow(frame->flesh, static_cast<double>(frame->capture_ns - last_ns) * 1e-9,
                    has_true_parts ? &parts : nullptr);
    }
    last_ns = frame->capture_ns;
    ScoredFrame& scored = followed.emplace_back();
    scored.timestamp_ns = frame->capture_ns;
    scored.tracked = stages.is_tracked();
    if (scored.tracked) scored.points_W = ScoredPointsOf(stages.points_W());
  }
  return followed;
}

double TrackedShare(const std::vector<ScoredFrame>& followed) {
  double frames = 0, tracked = 0;
  for (const ScoredFrame& frame : followed) {
    if (frame.timestamp_ns - followed.front().timestamp_ns < kAcquiredWithinNs) continue;
    ++frames;
    tracked += frame.tracked;
  }
  return frames > 0 ? tracked / frames : 0;
}

}  // namespace

CarvedTake CarveTake(const SimulatedStudioOptions& studio) {
  FleshKeeper keeper;
  Pipeline pipeline(OpenSimulatedStudio(studio),
                    {.voxel_mm = Config().voxel_mm,
                     .overflow = Overflow::kWait,
                     .tracker = TrackerKind::kMikic2003},
                    LoadBodyTable(kPaperBody), keeper);
  pipeline.Start();
  pipeline.Join();
  CarvedTake take{.motion = studio.motion,
                  .stature_mm = studio.stature_mm,
                  .seed = studio.seed,
                  .frames = std::move(keeper.frames)};
  const SimulatedTruth simulated(studio);
  for (CarvedTake::Frame& frame : take.frames)
    frame.truth_W = TrueScoredPoints(simulated, frame.capture_ns);
  return take;
}

PaperScore ScoreTake(const CarvedTake& take, int step, PaperTruth truth) {
  const Frames frames = EachOf(take, step);
  if (frames.empty()) return {};
  std::vector<ScoredFrame> true_frames;
  for (const CarvedTake::Frame* frame : frames)
    true_frames.push_back({.timestamp_ns = frame->capture_ns, .points_W = frame->truth_W});
  const std::vector<ScoredFrame> followed =
      truth == PaperTruth::kNothing
          ? FollowAsPublished(frames)
          : FollowFromTruth(frames, take.stature_mm, truth == PaperTruth::kStartAndParts);
  const Accuracy accuracy = MeasureAccuracy(true_frames, followed);
  return {.acquired = accuracy.first_tracked_frame >= 0,
          .mean_mm = accuracy.distance_mm.mean,
          .median_mm = accuracy.distance_mm.median,
          .head_share = accuracy.head_found_share,
          .tracked_share = TrackedShare(followed)};
}

PaperRow RunPaperTrial(const SimulatedStudioOptions& studio) {
  const CarvedTake take = CarveTake(studio);
  PaperRow row{.motion = take.motion, .stature_mm = take.stature_mm, .seed = take.seed};
  for (std::size_t truth = 0; truth < row.scores.size(); ++truth) {
    for (std::size_t rate = 0; rate < kPaperSteps.size(); ++rate) {
      row.scores[truth][rate] = ScoreTake(take, kPaperSteps[rate], static_cast<PaperTruth>(truth));
    }
  }
  return row;
}

}  // namespace mocap
