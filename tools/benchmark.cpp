#include "tools/benchmark.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
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
#include "tools/accuracy/carving_trial.h"
#include "tools/accuracy/evidence_report.h"
#include "tools/accuracy/paper_report.h"
#include "tools/accuracy/sweep_plan.h"
#include "tools/accuracy/variety_trial.h"

namespace mocap {
namespace {

// Defaults of a part.
constexpr double kSeconds = 10, kPeopleSeconds = 20, kStudioSeconds = 2, kPaperSeconds = 4,
                 kEvidenceSeconds = 2;
constexpr int kSeeds = 3, kPeopleSeeds = 2, kStudioSeeds = 2, kVariedPeople = 200,
              kEvidenceSeeds = 1;
const std::vector<std::string> kMotions = {"walk", "run", "jump",  "dance",  "sit",
                                           "step", "lie", "stand", "gesture"};
const std::vector<std::string> kPeopleMotions = {"walk", "meet", "dance", "visit"};
const std::vector<std::string> kSweepMotions = {"walk", "dance", "sit"};
const std::vector<std::string> kPaperMotions = {"walk", "run", "dance", "sit", "step", "jump"};
const std::vector<std::string> kEvidenceMotions = {"walk"};
const std::vector<double> kStatures_mm = {1150, 1550, 1950}, kPaperStatures_mm = {1300, 1750, 1880},
                          kEvidenceStatures_mm = {1750};

struct BenchmarkOptions {
  std::filesystem::path out;
  double seconds = 0;  ///< 0: the part's default above; also if others are empty or 0.
  std::vector<std::string> motions;
  std::vector<double> statures_mm;
  int seeds = 0;
  std::vector<std::string> parts = {"grid",        "cameras", "voxels", "covered",
                                    "calibration", "mishap",  "tracker"};

  std::vector<std::string> MotionsOr(const std::vector<std::string>& usual) const {
    return motions.empty() ? usual : motions;
  }
  std::vector<double> StaturesOr(const std::vector<double>& usual) const {
    return statures_mm.empty() ? usual : statures_mm;
  }
  double SecondsOr(double usual) const { return seconds > 0 ? seconds : usual; }
  int SeedsOr(int usual) const { return seeds > 0 ? seeds : usual; }
};

// Each takes as long as all others together or longer, so they run only on request.
const std::string kPeoplePart = "people", kVarietyPart = "variety", kStudioPart = "studio",
                  kPaperPart = "paper", kEvidencePart = "evidence";

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

/// Every motion of every stature with every seed.
struct TakeGrid {
  std::vector<std::string> motions;
  std::vector<double> statures_mm;
  int seeds = 0;
  double seconds = 0;  ///< Length of a take.
};

/// The studio of each take; what the grid does not say is as usual.
std::vector<SimulatedStudioOptions> StudiosOf(const TakeGrid& grid,
                                              const SimulatedStudioOptions& usual) {
  std::vector<SimulatedStudioOptions> studios;
  for (const std::string& motion : grid.motions) {
    for (const double stature_mm : grid.statures_mm) {
      for (int seed = 1; seed <= grid.seeds; ++seed) {
        SimulatedStudioOptions& studio = studios.emplace_back(usual);
        studio.motion = motion;
        studio.stature_mm = stature_mm;
        studio.seed = static_cast<std::uint64_t>(seed);
        studio.seconds = grid.seconds;
      }
    }
  }
  return studios;
}

std::vector<AccuracyRow> RunGrid(const TakeGrid& grid, const AccuracyTrial& usual) {
  std::vector<AccuracyRow> rows;
  for (const SimulatedStudioOptions& studio : StudiosOf(grid, usual.studio)) {
    AccuracyTrial trial = usual;
    trial.studio = studio;
    rows.push_back(MeasureAndPrint(trial));
  }
  return rows;
}

std::vector<PaperRow> RunPaper(const BenchmarkOptions& options) {
  const TakeGrid grid{.motions = options.MotionsOr(kPaperMotions),
                      .statures_mm = options.StaturesOr(kPaperStatures_mm),
                      .seeds = options.SeedsOr(kSeeds),
                      .seconds = options.SecondsOr(kPaperSeconds)};
  std::vector<PaperRow> rows;
  PrintNow(PaperHeader());
  for (const SimulatedStudioOptions& studio : StudiosOf(grid, RecordedSimulation())) {
    rows.push_back(RunPaperTrial(studio));
    PrintNow(PaperLine(rows.back()));
  }
  return rows;
}

std::vector<EvidenceRow> RunEvidence(const BenchmarkOptions& options) {
  const TakeGrid grid{.motions = options.MotionsOr(kEvidenceMotions),
                      .statures_mm = options.StaturesOr(kEvidenceStatures_mm),
                      .seeds = options.SeedsOr(kEvidenceSeeds),
                      .seconds = options.SecondsOr(kEvidenceSeconds)};
  std::vector<EvidenceRow> rows;
  PrintNow(EvidenceHeader());
  for (const EvidenceKind& kind : PlannedEvidence()) {
    for (SimulatedStudioOptions studio : StudiosOf(grid, RecordedSimulation())) {
      ApplyEvidence(kind, studio);
      rows.push_back(RunEvidenceTrial(studio));
      PrintNow(EvidenceLine(rows.back()));
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
    return part != kPeoplePart && part != kVarietyPart && part != kPaperPart &&
           part != kEvidencePart;
  });
}

AccuracySweep RunSweep(const SweepPlan& plan, const TakeGrid& grid) {
  AccuracySweep sweep{plan.what, {}};
  for (const SweepStep& step : plan.steps) {
    PrintNow(fmt::format("\n{}: {}\n", plan.what, step.label));
    AccuracyTrial trial;
    step.change(trial);
    sweep.steps.push_back({step.label, Summarize(RunGrid(grid, trial))});
  }
  return sweep;
}

std::vector<AccuracySweep> RunSweeps(const BenchmarkOptions& options) {
  const TakeGrid grid{.motions = kSweepMotions,
                      .statures_mm = {SimulatedStudioOptions().stature_mm},
                      .seeds = 1,
                      .seconds = options.SecondsOr(kSeconds)};
  std::vector<AccuracySweep> sweeps;
  for (const SweepPlan& plan : PlannedSweeps()) {
    if (Wants(options, plan.part)) sweeps.push_back(RunSweep(plan, grid));
  }
  return sweeps;
}

AccuracySweep RunStudios(const BenchmarkOptions& options) {
  return RunSweep(PlannedStudios(), {.motions = options.MotionsOr(kSweepMotions),
                                     .statures_mm = options.StaturesOr(kStatures_mm),
                                     .seeds = options.SeedsOr(kStudioSeeds),
                                     .seconds = options.SecondsOr(kStudioSeconds)});
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
                              .studios = {},
                              .people_seconds = options.SecondsOr(kPeopleSeconds),
                              .studio_seconds = options.SecondsOr(kStudioSeconds),
                              .people = {}};
  if (HasTakesOfTheGrid(options)) PrintNow(AccuracyHeader());
  if (Wants(options, "grid")) {
    benchmark.grid = RunGrid({.motions = options.MotionsOr(kMotions),
                              .statures_mm = options.StaturesOr(kStatures_mm),
                              .seeds = options.SeedsOr(kSeeds),
                              .seconds = options.SecondsOr(kSeconds)},
                             {});
    PrintNow("\n" + AccuracySummaryText(Summarize(benchmark.grid)));
  }
  benchmark.sweeps = RunSweeps(options);
  if (Wants(options, kStudioPart)) {
    benchmark.studios = RunStudios(options);
    PrintNow(SweepTable(benchmark.studios));
  }
  if (Wants(options, kPeoplePart)) {
    benchmark.people = RunPeople(options);
    PrintNow("\n" + PeopleSummaryText(benchmark.people));
  }
  std::vector<VarietyGrid> variety;
  if (Wants(options, kVarietyPart)) variety = RunVariety(options);
  std::vector<PaperRow> paper;
  if (Wants(options, kPaperPart)) {
    paper = RunPaper(options);
    PrintNow(PaperTables(paper));
  }
  std::vector<EvidenceRow> evidence;
  if (Wants(options, kEvidencePart)) {
    evidence = RunEvidence(options);
    PrintNow(EvidenceTable(evidence) + CarvingLines());
  }
  if (options.out.empty()) return;
  ReplaceText(options.out / "accuracy.md",
              AccuracyMarkdown(benchmark) + VarietyMarkdown(variety) +
                  PaperMarkdown(paper, options.SecondsOr(kPaperSeconds)) +
                  EvidenceMarkdown(evidence, options.SecondsOr(kEvidenceSeconds)));
  if (!benchmark.sweeps.empty()) {
    ReplaceText(options.out / "accuracy.svg", AccuracySweepsSvg(benchmark.sweeps));
  }
  if (!evidence.empty()) ReplaceText(options.out / "evidence.svg", EvidenceSvg(evidence));
}

}  // namespace

void AddBenchmarkCommand(CLI::App& app) {
  const auto options = std::make_shared<BenchmarkOptions>();
  CLI::App* command = app.add_subcommand(
      "benchmark", "Measure accuracy on a grid of simulated takes, and what affects it");
  command
      ->add_option(
          "--seconds", options->seconds,
          fmt::format("length of each take [s] (default: {}; several people: {}; studio: {}; "
                      "paper: {}; evidence: {})",
                      kSeconds, kPeopleSeconds, kStudioSeconds, kPaperSeconds, kEvidenceSeconds))
      ->check(NumberFrom(1, 600));
  command
      ->add_option(
          "--motions", options->motions,
          fmt::format(
              "motions of the people (default: {}; several people: {}; paper: {}; evidence: {})",
              fmt::join(kMotions, ","), fmt::join(kPeopleMotions, ","),
              fmt::join(kPaperMotions, ","), fmt::join(kEvidenceMotions, ",")))
      ->delimiter(',');
  command
      ->add_option("--statures", options->statures_mm,
                   fmt::format("statures of the people [mm] (default: {}; paper: {}; evidence: {})",
                               fmt::join(kStatures_mm, ","), fmt::join(kPaperStatures_mm, ","),
                               fmt::join(kEvidenceStatures_mm, ",")))
      ->delimiter(',')
      ->check(NumberFrom(1000, 2100));
  command
      ->add_option(
          "--seeds", options->seeds,
          fmt::format("number of random seeds per combination (default: {}; several people: {}; "
                      "studio: {}; variety: {}; evidence: {})",
                      kSeeds, kPeopleSeeds, kStudioSeeds, kVariedPeople, kEvidenceSeeds))
      ->check(NumberFrom(1, 1000));
  std::vector<std::string> parts = options->parts;
  parts.insert(parts.end(), {kPeoplePart, kVarietyPart, kStudioPart, kPaperPart, kEvidencePart});
  command
      ->add_option("--parts", options->parts,
                   "parts to run; people (two to four at once), variety (of builds, hair, clothes "
                   "and loads), studio (number, place and pictures of the cameras), paper (its "
                   "tracker, with truth in place of stages) and evidence (clothes like the wall, "
                   "and lossy pictures, of 4 to 16 cameras) run only on request")
      ->delimiter(',')
      ->check(OneOf(parts))
      ->capture_default_str();
  command->add_option("--out", options->out, "output folder for accuracy.md and its plots");
  command->callback([options] { RunBenchmark(*options); });
}

}  // namespace mocap
