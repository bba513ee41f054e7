#include "tools/track.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/load_config.h"
#include "config/open_studio.h"
#include "config/room_limits.h"
#include "config/subject_file.h"
#include "core/calibration/diagnosis_text.h"
#include "core/calibration/studio_diagnosis.h"
#include "core/errors.h"
#include "daemon/base/choice_option.h"
#include "daemon/base/json.h"
#include "daemon/base/number_option.h"
#include "daemon/pipeline/masked_camera.h"
#include "daemon/pipeline/pipeline.h"
#include "drivers/clock.h"
#include "drivers/nearest_name.h"
#include "drivers/printable_text.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/unfinished_folder.h"
#include "tools/remarks.h"
#include "tools/results/result.h"
#include "tools/results/result_sink.h"
#include "tools/results/take_identity.h"
#include "tools/stop_on_signals.h"

namespace mocap {
namespace {

struct TrackOptions {
  std::filesystem::path take;
  std::filesystem::path out;
  double voxel_mm = Config().voxel_mm;
  std::string body;  ///< Empty: the tracker's default.
  std::string tracker = Trackers().front().name;
  std::vector<std::string> cameras;
  std::optional<std::filesystem::path> masks;  ///< Empty: the take's own.
  std::optional<int> people;                   ///< Without: one, whose result is the take's.
  std::int64_t first = 0;
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

/// The folder of the given masks; empty: pictures are segmented.
std::filesystem::path MasksOf(const TrackOptions& options) {
  if (!options.masks) return {};
  return options.masks->empty() ? TakeLayout{options.take}.Masks() : *options.masks;
}

/// One camera gives no depth.
void RequireTwoCameras(const TrackOptions& options, const Studio& studio) {
  if (studio.cameras.size() >= 2) return;
  const std::string& only = studio.cameras.front().calibration.name;
  throw SetupError(options.cameras.empty()
                       ? options.take.string() + ": has frames of only " + only +
                             "; expected at least two cameras, and four for good poses"
                       : "--cameras: names only " + only +
                             "; expected at least two cameras, and four for good poses");
}

std::string WhyNobody(const std::optional<Finding>& fault, std::span<const SeenMoment> moments) {
  if (fault) return fault->text;
  const auto show = std::ranges::count_if(moments, ShowsPerson);
  return 2 * show > std::ssize(moments) ? "people are visible, but nobody could be tracked: at "
                                          "least three cameras must see the whole person"
                                        : "nobody is seen by most of the cameras at once";
}

/// Says what is wrong with the cameras, or why nobody was tracked.
/// @throws std::runtime_error  if nobody was tracked, because of the calibration or where an
/// earlier result has poses: a result is replaced only by a result.
void TellFault(const TrackOptions& options, const std::vector<CameraCalibration>& cameras,
               std::span<const SeenMoment> moments, std::size_t tracked) {
  const StudioDiagnosis diagnosis = Diagnose(cameras, moments);
  const std::string take = options.take.string() + ": ";
  const std::optional<Finding> fault = FindingOf(diagnosis, cameras);
  // What is tracked above the floor while people walk below it is nobody.
  const bool is_nobody =
      diagnosis.fault == StudioFault::kFloor && diagnosis.person.is_below_floor();
  if (tracked > 0 && !is_nobody) {
    if (IsOfCameras(diagnosis.fault)) TellRemarks("track", {take + fault->text});
    return;
  }
  const std::string why = take + WhyNobody(fault, moments);
  if (HasPoses(options.out))
    throw std::runtime_error("nobody was tracked: " + why + "; the earlier result in " +
                             options.out.string() + " is kept");
  if (fault && fault->severity == Severity::kWrong)
    throw std::runtime_error("nobody was tracked: " + why);
  TellRemarks("track", {why});
}

/// Names the parts of a result: poses.csv, or person-1 and so on.
std::vector<std::string> PartsOf(const std::filesystem::path& result) {
  std::vector<std::string> parts;
  if (IsThere(result / "poses.csv")) parts.emplace_back("poses.csv");
  for (const std::filesystem::path& person : PersonFolders(result)) {
    if (IsThere(person / "poses.csv")) parts.push_back(person.filename().string());
  }
  return parts;
}

/// Writes the result, and says what it removes of an earlier one without writing it anew.
void Write(const TrackOptions& options, const ResultSink& sink) {
  std::vector<std::string> removed = PartsOf(options.out);
  if (options.people)
    WritePeople(options.out, sink.people());
  else
    WriteResult(options.out, sink.result());
  for (const std::string& part : PartsOf(options.out)) std::erase(removed, part);
  if (!removed.empty())
    TellRemarks("track", {options.out.string() + ": replaces an earlier result; removed its " +
                          ListedNames(removed)});
}

SetupError NothingToTrack(const TrackOptions& options, const PipelineStatus& status) {
  const std::int64_t sets = status.sets_complete + status.sets_partial;
  if (sets == 0)
    return SetupError(options.take.string() + ": no frames of two cameras match in time");
  return SetupError(options.take.string() + ": has " + Counted(sets, "frame set") +
                    ", and --first is " + std::to_string(options.first) + "; expected at most " +
                    std::to_string(sets - 1));
}

void Track(const TrackOptions& options) {
  StopOnSignals();
  const NamedTracker& tracker = TrackerOf(options.tracker);
  Studio studio = OpenTake(options.take, {.cameras = options.cameras, .masks = MasksOf(options)});
  RequireTwoCameras(options, studio);
  const std::vector<CameraCalibration> cameras = CalibrationsOf(studio);
  RequireRoom(cameras, options.voxel_mm, TakeLayout{options.take}.Calibration().string());
  TellRemarks("track", studio.remarks);
  std::optional<UnfinishedFolder> new_folder;
  if (!IsThere(options.out)) new_folder.emplace(options.out);
  RequireRoomForResult(options.out);
  ResultSink sink(options.people ? KeptPeople::kEverybody : KeptPeople::kFirst,
                  isatty(STDERR_FILENO) == 1, MarkOf(options.take));
  const OpenElsewhere masked = options.masks ? TakeMaskedCameras(studio) : nullptr;
  Pipeline pipeline(std::move(studio),
                    {.voxel_mm = options.voxel_mm,
                     .overflow = Overflow::kWait,
                     .latency_origin = LatencyOrigin::kArrival,
                     .tracker = tracker.kind,
                     .people = options.people.value_or(1),
                     .first_set = options.first,
                     .elsewhere = masked},
                    LoadBodyTable(options.body.empty() ? tracker.body : options.body), sink);
  const std::filesystem::path subject = TakeLayout{options.take}.Subject();
  if (!options.measure && IsThere(subject)) {
    pipeline.ChangeSubject(KnownPerson{"", LoadSubject(subject)});
  }
  const std::int64_t begin_ns = SteadyNs();
  pipeline.Start();
  pipeline.Join();
  const double seconds = static_cast<double>(SteadyNs() - begin_ns) / 1e9;
  sink.EndProgress();
  if (sink.frames() == 0) throw NothingToTrack(options, pipeline.Status());
  TellFault(options, cameras, pipeline.Moments(), sink.tracked_frames());
  Write(options, sink);
  if (new_folder) new_folder->Finish();
  if (options.json) {
    std::puts(JsonOf(sink, pipeline.Status().stages, seconds).c_str());
  } else {
    const std::string people =
        options.people ? ", people: " + std::to_string(sink.people().size()) : "";
    std::printf("%s, %zu tracked%s, at %.1f a second: %s\n",
                Counted(sink.frames(), "frame set").c_str(), sink.tracked_frames(), people.c_str(),
                static_cast<double>(sink.frames()) / seconds,
                Printable(options.out.string()).c_str());
  }
}

}  // namespace

void AddTrackCommand(CLI::App& app) {
  auto options = std::make_shared<TrackOptions>();
  CLI::App* command = app.add_subcommand("track", "Track the people in a take");
  command->add_option("TAKE", options->take, "take folder")->required();
  command->add_option("--out", options->out, "output result folder (poses.csv, body.toml)")
      ->required();
  command->add_option("--voxel-size", options->voxel_mm, "voxel edge length [mm]")
      ->check(NumberFrom(10, 100))
      ->capture_default_str();
  command->add_option("--tracker", options->tracker, "tracking algorithm; mikic2003 is the paper's")
      ->check(OneOf(TrackerNames()))
      ->capture_default_str();
  command->add_option(
      "--body", options->body,
      "body model: mikic2003, full or a body table file (default: the tracker's own)");
  command->add_option("--cameras", options->cameras, "use only these cameras, such as cam1,cam2")
      ->delimiter(',');
  command
      ->add_option("--people", options->people,
                   "track up to this many people; one result folder each, person-1 and so on "
                   "(default: one person)")
      ->check(NumberFrom(1, kMostPeople));
  command
      ->add_option("--first", options->first,
                   "number of the first frame set to track; earlier ones are left out")
      ->check(NumberFrom(0, 1e9))
      ->capture_default_str();
  command
      ->add_option_function<std::string>(
          "--masks", [options](const std::string& folder) { options->masks = folder; },
          "take silhouettes from masks, CAMERA.mkv with white people, instead of the pictures "
          "(default folder: the take's silhouette)")
      ->expected(0, 1)
      ->type_name("[DIR]");
  command->add_flag("--measure", options->measure,
                    "measure the person's sizes even if the take contains them");
  command->add_flag("--json", options->json, "print one JSON object");
  command->callback([options] { Track(*options); });
}

}  // namespace mocap
