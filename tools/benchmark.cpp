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
#include "daemon/base/number_option.h"
#include "drivers/take/text_file.h"
#include "tools/accuracy/accuracy_benchmark.h"
#include "tools/accuracy/accuracy_report.h"

namespace mocap {
namespace {

struct BenchmarkOptions {
  std::filesystem::path out;
  double seconds = 10;
  std::vector<std::string> motions = {"walk", "run", "jump", "dance", "sit", "step", "stand"};
  std::vector<double> statures_mm = {1150, 1550, 1950};
  int seeds = 3;
  std::vector<std::string> parts = {"grid",        "cameras", "voxels", "covered",
                                    "calibration", "mishap",  "tracker"};
};

bool Wants(const BenchmarkOptions& options, const std::string& part) {
  return std::ranges::find(options.parts, part) != options.parts.end();
}

void Print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

AccuracyRow MeasureAndPrint(const AccuracyTrial& trial) {
  const AccuracyRow row = Measure(trial);
  Print(AccuracyLine(row));
  return row;
}

std::vector<AccuracyRow> RunGrid(const BenchmarkOptions& options) {
  std::vector<AccuracyRow> rows;
  for (const std::string& motion : options.motions) {
    for (const double stature_mm : options.statures_mm) {
      for (int seed = 1; seed <= options.seeds; ++seed) {
        AccuracyTrial trial;
        trial.studio.motion = motion;
        trial.studio.stature_mm = stature_mm;
        trial.studio.seed = static_cast<std::uint64_t>(seed);
        trial.studio.seconds = options.seconds;
        rows.push_back(MeasureAndPrint(trial));
      }
    }
  }
  return rows;
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
      Print(fmt::format("\n{}: {}\n", what, step.label));
      std::vector<AccuracyRow> rows;
      for (const char* motion : {"walk", "dance", "sit"}) {
        AccuracyTrial trial;
        trial.studio.motion = motion;
        trial.studio.seconds = options.seconds;
        step.change(trial);
        rows.push_back(MeasureAndPrint(trial));
      }
      sweep.steps.push_back({step.label, Summarize(rows)});
    }
  }
  return sweeps;
}

void RunBenchmark(const BenchmarkOptions& options) {
  // Before the work, to find out at once whether its result can be kept.
  if (!options.out.empty()) {
    MakeFolder(options.out);
    RequireWritable(options.out / "accuracy.md");
    constexpr std::string_view kBeginning = "# Accuracy on simulated people";
    RequireOwn(options.out / "accuracy.md", std::span(&kBeginning, 1), "a benchmark");
  }
  AccuracyBenchmark benchmark{.seconds = options.seconds, .grid = {}, .sweeps = {}};
  Print(AccuracyHeader());
  if (Wants(options, "grid")) {
    benchmark.grid = RunGrid(options);
    Print("\n" + AccuracySummaryText(Summarize(benchmark.grid)));
  }
  benchmark.sweeps = RunSweeps(options);
  if (options.out.empty()) return;
  ReplaceText(options.out / "accuracy.md", AccuracyMarkdown(benchmark));
  if (!benchmark.sweeps.empty()) {
    ReplaceText(options.out / "accuracy.svg", AccuracySweepsSvg(benchmark.sweeps));
  }
}

}  // namespace

void AddBenchmarkCommand(CLI::App& app) {
  const auto options = std::make_shared<BenchmarkOptions>();
  CLI::App* command = app.add_subcommand(
      "benchmark", "Measures accuracy on a grid of simulated takes, and what makes it worse");
  command->add_option("--seconds", options->seconds, "length of each take")
      ->check(NumberFrom(1, 600))
      ->capture_default_str();
  command->add_option("--motions", options->motions, "what people do, as in walk,dance")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--statures", options->statures_mm, "how tall they are [mm]")
      ->delimiter(',')
      ->check(NumberFrom(1000, 2100))
      ->capture_default_str();
  command->add_option("--seeds", options->seeds, "how many people of each")
      ->check(NumberFrom(1, 1000))
      ->capture_default_str();
  command->add_option("--parts", options->parts, "what to measure")
      ->delimiter(',')
      ->check(CLI::IsMember(options->parts))
      ->capture_default_str();
  command->add_option("--out", options->out, "folder for accuracy.md and accuracy.svg");
  command->callback([options] { RunBenchmark(*options); });
}

}  // namespace mocap
