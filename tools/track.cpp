#include "tools/track.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/load_config.h"
#include "core/errors.h"
#include "daemon/base/choice_option.h"
#include "daemon/base/json.h"
#include "daemon/base/number_option.h"
#include "daemon/pipeline/pipeline.h"
#include "drivers/clock.h"
#include "drivers/printable_text.h"
#include "tools/recorded_keypoints.h"
#include "tools/results/result_sink.h"
#include "tools/results/take_identity.h"
#include "tools/stop_on_signals.h"
#include "tools/tracked_take.h"

namespace mocap {
namespace {

struct TrackOptions {
  TrackedTake tracked{.command = "track"};
  double voxel_mm = Config().voxel_mm;
  std::string body;  ///< Empty: the tracker's default.
  std::string tracker = Trackers().front().name;
  std::int64_t first = 0;
  std::optional<std::filesystem::path> keypoints;
  bool measure = false;
  bool json = false;
};

std::string JsonOf(const ResultSink& sink, const StageHistograms& stages, double seconds) {
  Json json = Json::object();
  json["frames"] = sink.frames();
  json["tracked_frames"] = sink.tracked_frames();
  json["acquisition_frames"] = sink.acquisition_frames();
  if (!sink.people().empty()) json["people"] = sink.people().size();
  for (const Stage stage :
       {Stage::kSegment, Stage::kCarve, Stage::kLabel, Stage::kFilter, Stage::kTotal}) {
    Json timing = Json::object();
    timing["p50_ms"] = Rounded(stages[stage].PercentileMs(0.5), 3);
    timing["p99_ms"] = Rounded(stages[stage].PercentileMs(0.99), 3);
    json[std::string(kStageNames[static_cast<std::size_t>(stage)])] = timing;
  }
  json["frames_per_second"] = Rounded(static_cast<double>(sink.frames()) / seconds, 2);
  return JsonText(json);
}

// @pre  the name is valid.
const NamedTracker& TrackerOf(const std::string& name) {
  return *std::ranges::find(Trackers(), name, &NamedTracker::name);
}

SetupError NothingToTrack(const TrackOptions& options, const PipelineStatus& status) {
  const std::int64_t sets = status.sets_complete + status.sets_partial;
  if (sets == 0)
    return SetupError(options.tracked.take.string() + ": no frames of two cameras match in time");
  return SetupError(options.tracked.take.string() + ": has " + Counted(sets, "frame set") +
                    ", and --first is " + std::to_string(options.first) + "; expected at most " +
                    std::to_string(sets - 1));
}

std::unique_ptr<KeypointSource> KeypointsOf(const TrackOptions& options,
                                            std::span<const CameraCalibration> cameras) {
  if (!options.keypoints) return nullptr;
  std::vector<std::string> names;
  for (const CameraCalibration& camera : cameras) names.push_back(camera.name);
  return std::make_unique<RecordedKeypoints>(*options.keypoints, names);
}

void Track(const TrackOptions& options) {
  StopOnSignals();
  const NamedTracker& tracker = TrackerOf(options.tracker);
  Studio studio = OpenTrackedTake(options.tracked, options.voxel_mm);
  const std::vector<CameraCalibration> cameras = CalibrationsOf(studio);
  std::optional<UnfinishedFolder> new_folder;
  RequireOut(options.tracked, new_folder);
  ResultSink sink(options.tracked.people ? KeptPeople::kEverybody : KeptPeople::kFirst,
                  isatty(STDERR_FILENO) == 1, MarkOf(options.tracked.take));
  const std::unique_ptr<KeypointSource> keypoints = KeypointsOf(options, cameras);
  const OpenElsewhere masked = MaskedCamerasOf(options.tracked, studio);
  Pipeline pipeline(std::move(studio),
                    {.voxel_mm = options.voxel_mm,
                     .overflow = Overflow::kWait,
                     .latency_origin = LatencyOrigin::kArrival,
                     .tracker = tracker.kind,
                     .people = options.tracked.people.value_or(1),
                     .first_set = options.first,
                     .keypoints = keypoints.get(),
                     .elsewhere = masked},
                    LoadBodyTable(options.body.empty() ? tracker.body : options.body), sink);
  const std::optional<KnownPerson> subject = SubjectOf(options.tracked);
  if (!options.measure && subject) pipeline.ChangeSubject(subject);
  const std::int64_t begin_ns = SteadyNs();
  pipeline.Start();
  pipeline.Join();
  const double seconds = static_cast<double>(SteadyNs() - begin_ns) / 1e9;
  sink.EndProgress();
  if (sink.frames() == 0) throw NothingToTrack(options, pipeline.Status());
  TellFault(options.tracked, cameras, pipeline.Moments(), sink.tracked_frames());
  WriteTracked(options.tracked, sink.result(), sink.people());
  if (new_folder) new_folder->Finish();
  if (options.json) {
    std::puts(JsonOf(sink, pipeline.Status().stages, seconds).c_str());
  } else {
    const std::string people =
        options.tracked.people ? ", people: " + std::to_string(sink.people().size()) : "";
    std::printf("%s, %zu tracked%s, at %.1f a second: %s\n",
                Counted(sink.frames(), "frame set").c_str(), sink.tracked_frames(), people.c_str(),
                static_cast<double>(sink.frames()) / seconds,
                Printable(options.tracked.out.string()).c_str());
  }
}

}  // namespace

void AddTrackCommand(CLI::App& app) {
  auto options = std::make_shared<TrackOptions>();
  CLI::App* command = app.add_subcommand("track", "Track the people in a take");
  AddTakeOptions(*command, options->tracked);
  command->add_option("--voxel-size", options->voxel_mm, "voxel edge length [mm]")
      ->check(NumberFrom(10, 100))
      ->capture_default_str();
  command->add_option("--tracker", options->tracker, "tracking algorithm; mikic2003 is the paper's")
      ->check(OneOf(TrackerNames()))
      ->capture_default_str();
  command->add_option(
      "--body", options->body,
      "body model: mikic2003, full or a body table file (default: the tracker's own)");
  command
      ->add_option("--first", options->first,
                   "number of the first frame set to track; earlier ones are left out")
      ->check(NumberFrom(0, 1e9))
      ->capture_default_str();
  command->add_option("--keypoints", options->keypoints,
                      "weigh these keypoints of people in pictures, as mocap witness writes them");
  command->add_flag("--measure", options->measure,
                    "measure the person's sizes even if the take contains them");
  command->add_flag("--json", options->json, "print one JSON object");
  command->callback([options] { Track(*options); });
}

}  // namespace mocap
