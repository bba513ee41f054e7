#include "tools/solve.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "config/config.h"
#include "config/load_config.h"
#include "config/open_studio.h"
#include "core/errors.h"
#include "daemon/base/json.h"
#include "daemon/base/number_option.h"
#include "drivers/clock.h"
#include "drivers/nearest_name.h"
#include "drivers/printable_text.h"
#include "tools/results/take_identity.h"
#include "tools/solving/solve_studio.h"
#include "tools/stop_on_signals.h"
#include "tools/tracked_take.h"

namespace mocap {
namespace {

constexpr int kMostJobs = 256;

struct SolveCommand {
  TrackedTake tracked{.command = "solve"};
  std::string filter = NamedFilter().name();
  int jobs = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostJobs);
  bool json = false;
};

/// Shows the present step on a terminal.
class ProgressLine {
 public:
  ~ProgressLine() {
    if (is_shown_) std::fputs("\r\x1b[K", stderr);
  }
  void Tell(const std::string& step) const {
    if (is_shown_) std::fprintf(stderr, "\r\x1b[K%s", step.c_str());
  }

 private:
  const bool is_shown_ = isatty(STDERR_FILENO) == 1;
};

/// Files beside the result, which stay when the command is interrupted.
std::filesystem::path WorkOf(const TrackedTake& tracked) {
  std::filesystem::path out = tracked.out;
  if (!out.has_filename()) out = out.parent_path();
  return out += ".solving";
}

/// What a solve depends on, besides the filter, which comes last.
std::string MarkFor(const TrackedTake& tracked, const TakeMark& take) {
  Json mark = Json::object();
  mark["version"] = MOCAP_VERSION;
  mark["take"] = take.name;
  mark["calibration"] = take.calibration;
  mark["cameras"] = tracked.cameras;
  mark["masks"] = tracked.masks ? tracked.masks->string() : "no";
  mark["people"] = tracked.people.value_or(0);
  const std::optional<KnownPerson> subject = SubjectOf(tracked);
  mark["stature_mm"] = subject ? subject->sizes.Stature() : 0;
  return JsonText(mark);
}

std::size_t TrackedSetsOf(const Solved& solved) {
  std::size_t most = 0;
  for (const auto& [number, person] : solved.people)
    most = std::max(most, static_cast<std::size_t>(std::ranges::count_if(
                              person.poses, [](const PoseRow& row) { return row.has_pose; })));
  return most;
}

void Report(const SolveCommand& command, const Solved& solved, double seconds) {
  if (command.json) {
    Json json = Json::object();
    json["frames"] = solved.sets;
    json["tracked_frames"] = TrackedSetsOf(solved);
    if (command.tracked.people) json["people"] = solved.people.size();
    json["filter"] = command.filter;
    json["seconds"] = Rounded(seconds, 1);
    std::puts(JsonText(json).c_str());
    return;
  }
  const std::string people =
      command.tracked.people ? ", people: " + std::to_string(solved.people.size()) : "";
  std::printf("%s, %zu tracked%s, in %.0f s: %s\n", Counted(solved.sets, "frame set").c_str(),
              TrackedSetsOf(solved), people.c_str(), seconds,
              Printable(command.tracked.out.string()).c_str());
}

void Solve(const SolveCommand& command) {
  StopOnSignals();
  const TrackedTake& tracked = command.tracked;
  const NamedFilter filter = ParseFilter(command.filter);
  const std::int64_t begin_ns = SteadyNs();
  Studio studio = OpenTrackedTake(tracked, Config().voxel_mm);
  const std::vector<CameraCalibration> cameras = CalibrationsOf(studio);
  std::optional<UnfinishedFolder> new_folder;
  RequireOut(tracked, new_folder);
  const TakeMark mark = MarkOf(tracked.take);
  const std::filesystem::path work = WorkOf(tracked);
  const OpenElsewhere masked = MaskedCamerasOf(tracked, studio);
  Solved solved;
  {
    const ProgressLine progress;
    solved = SolveStudio(std::move(studio), LoadBodyTable(Config().body),
                         {.voxel_mm = Config().voxel_mm,
                          .people = tracked.people,
                          .filter = filter,
                          .work = work,
                          .mark = MarkFor(tracked, mark),
                          .jobs = command.jobs,
                          .masked = masked,
                          .subject = SubjectOf(tracked),
                          .take = mark,
                          .tell = [&](const std::string& step) { progress.Tell(step); }});
  }
  if (solved.sets == 0) {
    std::filesystem::remove_all(work);
    throw SetupError(tracked.take.string() + ": no frames of two cameras match in time");
  }
  TellFault(tracked, cameras, solved.moments, TrackedSetsOf(solved));
  const Result nobody;
  WriteTracked(tracked, solved.people.empty() ? nobody : solved.people.begin()->second,
               solved.people);
  if (new_folder) new_folder->Finish();
  std::filesystem::remove_all(work);
  Report(command, solved, static_cast<double>(SteadyNs() - begin_ns) / 1e9);
}

}  // namespace

void AddSolveCommand(CLI::App& app) {
  auto options = std::make_shared<SolveCommand>();
  CLI::App* command = app.add_subcommand(
      "solve", "Track the people in a take with everything that the whole take shows");
  AddTakeOptions(*command, options->tracked);
  command
      ->add_option("--filter", options->filter,
                   "filter of the result: none, or butterworth:ORDER:HZ without delay; "
                   "butterworth:4:6 is usual for gait")
      ->capture_default_str();
  command->add_option("--jobs", options->jobs, "number of threads (default: one per processor)")
      ->check(NumberFrom(1, kMostJobs));
  command->add_flag("--json", options->json, "print one JSON object");
  command->callback([options] { Solve(*options); });
}

}  // namespace mocap
