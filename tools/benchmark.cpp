#include "tools/benchmark.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/load_config.h"
#include "daemon/base/choice_option.h"
#include "daemon/base/number_option.h"
#include "drivers/simulation/company.h"
#include "drivers/take/text_file.h"
#include "tools/accuracy/accuracy_benchmark.h"
#include "tools/accuracy/accuracy_report.h"
#include "tools/accuracy/variety_trial.h"

namespace mocap {
namespace {

// Defaults of a part.
constexpr double kSeconds = 10, kPeopleSeconds = 20;
constexpr int kSeeds = 3, kPeopleSeeds = 2, kVariedPeople = 200;
const std::vector<std::string> kMotions = {"walk", "run", "jump",  "dance",  "sit",
                                           "step", "lie", "stand", "gesture"};
const std::vector<std::string> kPeopleMotions = {"walk", "meet", "dance", "visit"};

struct BenchmarkOptions {
  std::filesystem::path out;
  double seconds = 0;  ///< 0: the part's default below; also if motions or seeds are empty.
  std::vector<std::string> motions;
  std::vector<double> statures_mm = {1150, 1550, 1950};
  int seeds = 0;
  std::vector<std::string> parts = {"grid",        "cameras", "voxels", "covered",
                                    "calibration", "mishap",  "tracker"};

  std::vector<std::string> MotionsOr(const std::vector<std::string>& usual) const {
    return motions.empty() ? usual : motions;
  }
  double SecondsOr(double usual) const { return seconds > 0 ? seconds : usual; }
  int SeedsOr(int usual) const { return seeds > 0 ? seeds : usual; }
};

// Each takes as long as all others together or longer, so they run only on request.
const std::string kPeoplePart = "people", kVarietyPart = "variety";

bool Wants(const BenchmarkOptions& options, const std::string& part) {
  return std::ranges::find(options.parts, part) != options.parts.end();
}

void PrintNow(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

AccuracyRow MeasureAndPrint(const AccuracyTrial& trial) {
  const AccuracyRow row = Measure(trial);
  PrintNow(AccuracyLine(row));
  return row;
}

std::vector<AccuracyRow> RunGrid(const BenchmarkOptions& options) {
  std::vector<AccuracyRow> rows;
  for (const std::string& motion : options.MotionsOr(kMotions)) {
    for (const double stature_mm : options.statures_mm) {
      for (int seed = 1; seed <= options.SeedsOr(kSeeds); ++seed) {
        AccuracyTrial trial;
        trial.studio.motion = motion;
        trial.studio.stature_mm = stature_mm;
        trial.studio.seed = static_cast<std::uint64_t>(seed);
        trial.studio.seconds = options.SecondsOr(kSeconds);
        rows.push_back(MeasureAndPrint(trial));
      }
    }
  }
  return rows;
}

std::vector<PeopleRow> RunPeople(const BenchmarkOptions& options) {
  std::vector<PeopleRow> rows;
  PrintNow(PeopleHeader());
  for (const std::string& motion : options.MotionsOr(kPeopleMotions)) {
    for (int people = 2; people <= simulation::kMostSimulatedPeople; ++people) {
      for (int seed = 1; seed <= options.SeedsOr(kPeopleSeeds); ++seed) {
        SimulatedStudioOptions studio = RecordedSimulation();
        studio.motion = motion;
        studio.people = people;
        studio.seed = static_cast<std::uint64_t>(seed);
        studio.seconds = options.SecondsOr(kPeopleSeconds);
        rows.push_back(RunPeopleTrial(studio));
        PrintNow(PeopleLine(rows.back()));
      }
    }
  }
  return rows;
}

std::vector<VarietyGrid> RunVariety(const BenchmarkOptions& options) {
  std::vector<VarietyGrid> grids;
  for (const Filming& filming : Filmings()) {
    PrintNow(fmt::format("\nvaried people, {}\n{}", filming.label, VarietyHeader()));
    VarietyGrid& grid = grids.emplace_back(VarietyGrid{filming, {}});
    for (int number = 1; number <= options.SeedsOr(kVariedPeople); ++number) {
      grid.rows.push_back(RunVarietyTrial(number, options.SecondsOr(kSeconds), filming));
      PrintNow(VarietyLine(grid.rows.back()));
    }
    PrintNow(VarietySummaryText(grid.rows));
  }
  return grids;
}

bool HasTakesOfTheGrid(const BenchmarkOptions& options) {
  return std::ranges::any_of(options.parts, [](const std::string& part) {
    return part != kPeoplePart && part != kVarietyPart;
  });
}

struct Step {
  std::string label;
  std::function<void(AccuracyTrial&)> change;
};

struct SweepPlan {
  std::string part;
  std::string what;
  std::vector<Step> steps;
};

std::vector<SweepPlan> PlannedSweeps() {
  const auto cameras = [](int count) {
    return Step{std::to_string(count),
                [count](AccuracyTrial& trial) { trial.studio.cameras = count; }};
  };
  const auto voxels = [](int edge_mm) {
    return Step{std::to_string(edge_mm),
                [edge_mm](AccuracyTrial& trial) { trial.voxel_mm = edge_mm; }};
  };
  const auto covered = [](int percent) {
    return Step{std::to_string(percent),
                [percent](AccuracyTrial& trial) { trial.covered_share = percent / 100.0; }};
  };
  const auto calibration = [](int error_px) {
    return Step{std::to_string(error_px),
                [error_px](AccuracyTrial& trial) { trial.calibration_error_px = error_px; }};
  };
  const auto happens = [](const char* what, Mishap mishap) {
    return Step{what, [mishap](AccuracyTrial& trial) { trial.mishap = mishap; }};
  };
  std::vector<Step> trackers;
  for (const NamedTracker& tracker : Trackers()) {
    trackers.push_back({tracker.name, [tracker](AccuracyTrial& trial) {
                          trial.tracker = tracker.kind;
                          trial.body = tracker.body;
                        }});
  }
  return {{"cameras", "cameras", {cameras(4), cameras(5), cameras(6), cameras(8)}},
          {"voxels", "edge of a voxel [mm]", {voxels(10), voxels(25), voxels(50)}},
          {"covered",
           "pictures covered by squares [%]",
           {covered(0), covered(2), covered(5), covered(10)}},
          {"calibration",
           "error of calibration [px]",
           {calibration(0), calibration(1), calibration(2), calibration(5)}},
          {"mishap",
           "one camera of six, from the middle on",
           {happens("well", Mishap::kNone), happens("lost", Mishap::kLost),
            happens("blinded", Mishap::kBlinded), happens("turned by 20 px", Mishap::kTurned)}},
          {"tracker", "tracker", trackers}};
}

std::vector<AccuracySweep> RunSweeps(const BenchmarkOptions& options) {
  std::vector<AccuracySweep> sweeps;
  for (const auto& [part, what, steps] : PlannedSweeps()) {
    if (!Wants(options, part)) continue;
    AccuracySweep& sweep = sweeps.emplace_back(AccuracySweep{what, {}});
    for (const Step& step : steps) {
      PrintNow(fmt::format("\n{}: {}\n", what, step.label));
      std::vector<AccuracyRow> rows;
      for (const char* motion : {"walk", "dance", "sit"}) {
        AccuracyTrial trial;
        trial.studio.motion = motion;
        trial.studio.seconds = options.SecondsOr(kSeconds);
        step.change(trial);
        rows.push_back(MeasureAndPrint(trial));
      }
      sweep.steps.push_back({step.label, Summarize(rows)});
    }
  }
  return sweeps;
}

void RunBenchmark(const BenchmarkOptions& options) {
  // Checked before the work, so that a result cannot be lost.
  if (!options.out.empty()) {
    MakeFolder(options.out);
    RequireWritable(options.out / "accuracy.md");
    constexpr std::string_view kBeginning = "# Accuracy on simulated people";
    RequireOwn(options.out / "accuracy.md", std::span(&kBeginning, 1), "a benchmark");
  }
  AccuracyBenchmark benchmark{.seconds = options.SecondsOr(kSeconds),
                              .grid = {},
                              .sweeps = {},
                              .people_seconds = options.SecondsOr(kPeopleSeconds),
                              .people = {}};
  if (HasTakesOfTheGrid(options)) PrintNow(AccuracyHeader());
  if (Wants(options, "grid")) {
    benchmark.grid = RunGrid(options);
    PrintNow("\n" + AccuracySummaryText(Summarize(benchmark.grid)));
  }
  benchmark.sweeps = RunSweeps(options);
  if (Wants(options, kPeoplePart)) {
    benchmark.people = RunPeople(options);
    PrintNow("\n" + PeopleSummaryText(benchmark.people));
  }
  std::vector<VarietyGrid> variety;
  if (Wants(options, kVarietyPart)) variety = RunVariety(options);
  if (options.out.empty()) return;
  ReplaceText(options.out / "accuracy.md", AccuracyMarkdown(benchmark) + VarietyMarkdown(variety));
  if (!benchmark.sweeps.empty()) {
    ReplaceText(options.out / "accuracy.svg", AccuracySweepsSvg(benchmark.sweeps));
  }
}

}  // namespace

void AddBenchmarkCommand(CLI::App& app) {
  const auto options = std::make_shared<BenchmarkOptions>();
  CLI::App* command = app.add_subcommand(
      "benchmark", "Measure accuracy on a grid of simulated takes, and what affects it");
  command
      ->add_option("--seconds", options->seconds,
                   fmt::format("length of each take [s] (default: {}; several people: {})",
                               kSeconds, kPeopleSeconds))
      ->check(NumberFrom(1, 600));
  command
      ->add_option("--motions", options->motions,
                   fmt::format("motions of the people (default: {}; several people: {})",
                               fmt::join(kMotions, ","), fmt::join(kPeopleMotions, ",")))
      ->delimiter(',');
  command->add_option("--statures", options->statures_mm, "statures of the people [mm]")
      ->delimiter(',')
      ->check(NumberFrom(1000, 2100))
      ->capture_default_str();
  command
      ->add_option(
          "--seeds", options->seeds,
          fmt::format("number of random seeds per combination (default: {}; several people: {}; "
                      "variety: {})",
                      kSeeds, kPeopleSeeds, kVariedPeople))
      ->check(NumberFrom(1, 1000));
  std::vector<std::string> parts = options->parts;
  parts.insert(parts.end(), {kPeoplePart, kVarietyPart});
  command
      ->add_option("--parts", options->parts,
                   "parts to run; people (two to four at once) and variety (of builds, hair, "
                   "clothes and loads) run only on request")
      ->delimiter(',')
      ->check(OneOf(parts))
      ->capture_default_str();
  command->add_option("--out", options->out, "output folder for accuracy.md and accuracy.svg");
  command->callback([options] { RunBenchmark(*options); });
}

}  // namespace mocap
