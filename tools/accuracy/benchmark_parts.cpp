#include "tools/accuracy/benchmark_parts.h"

#include <fmt/format.h>

#include <cstdio>

#include "drivers/virtual_studio/motions/company.h"
#include "tools/accuracy/accuracy_report.h"
#include "tools/accuracy/evidence_report.h"
#include "tools/accuracy/paper_report.h"
#include "tools/accuracy/sweep_plan.h"
#include "tools/remarks.h"
#include "tools/report/extremity_text.h"

namespace mocap {
namespace {

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

std::vector<AccuracyRow> RunTakesOf(const TakeGrid& grid, const AccuracyTrial& usual) {
  std::vector<AccuracyRow> rows;
  for (const SimulatedStudioOptions& studio : StudiosOf(grid, usual.studio)) {
    AccuracyTrial trial = usual;
    trial.studio = studio;
    rows.push_back(MeasureAndPrint(trial));
  }
  return rows;
}

AccuracySweep RunSweep(const SweepPlan& plan, const TakeGrid& grid) {
  AccuracySweep sweep{plan.what, {}};
  for (const SweepStep& step : plan.steps) {
    PrintNow(fmt::format("\n{}: {}\n", plan.what, step.label));
    AccuracyTrial trial;
    step.change(trial);
    sweep.steps.push_back({step.label, Summarize(RunTakesOf(grid, trial))});
  }
  return sweep;
}

/// The first way of filming that is wanted.
Filming FilmingOf(const BenchmarkOptions& options) {
  const std::vector<Filming> all = Filmings();
  return *std::ranges::find_if(
      all, [&](const Filming& filming) { return options.IsFilmed(filming.label); });
}

}  // namespace

void PrintNow(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

std::vector<AccuracyRow> RunGrid(const BenchmarkOptions& options) {
  return RunTakesOf({.motions = options.MotionsOr(kMotions),
                     .statures_mm = options.StaturesOr(kStatures_mm),
                     .seeds = options.SeedsOr(kSeeds),
                     .seconds = options.SecondsOr(kSeconds)},
                    {});
}

std::vector<AccuracySweep> RunSweeps(const BenchmarkOptions& options) {
  const TakeGrid grid{.motions = kSweepMotions,
                      .statures_mm = {SimulatedStudioOptions().stature_mm},
                      .seeds = 1,
                      .seconds = options.SecondsOr(kSeconds)};
  std::vector<AccuracySweep> sweeps;
  for (const SweepPlan& plan : PlannedSweeps()) {
    if (options.Wants(plan.part)) sweeps.push_back(RunSweep(plan, grid));
  }
  return sweeps;
}

AccuracySweep RunStudios(const BenchmarkOptions& options) {
  return RunSweep(PlannedStudios(), {.motions = options.MotionsOr(kSweepMotions),
                                     .statures_mm = options.StaturesOr(kStatures_mm),
                                     .seeds = options.SeedsOr(kStudioSeeds),
                                     .seconds = options.SecondsOr(kStudioSeconds)});
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

std::vector<NoiseTake> RunNoise(const BenchmarkOptions& options) {
  std::vector<NoiseTake> takes;
  const int end = options.from + options.SeedsOr(kNoisePeople);
  for (int number = options.from; number < end; ++number) {
    takes.push_back(RunNoiseTrial(
        VarietyTrialOf(number, options.SecondsOr(kNoiseSeconds), Filmings().front())));
    PrintNow(fmt::format("person {}: {} sets, {} left out\n", number, takes.back().sets,
                         takes.back().left_out));
  }
  return takes;
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
    if (!options.IsFilmed(filming.label)) continue;
    PrintNow(fmt::format("\nvaried people, {}\n{}", filming.label, VarietyHeader()));
    VarietyGrid& grid = grids.emplace_back(VarietyGrid{filming, {}});
    for (int i = 0; i < options.SeedsOr(kVariedPeople); ++i) {
      grid.rows.push_back(RunVarietyTrial(options.from + i, options.SecondsOr(kSeconds), filming,
                                          options.FirstsOr(kFirsts)));
      PrintNow(VarietyLine(grid.rows.back()));
    }
    PrintNow(VarietySummaryText(grid.rows) + ExtremityText(MeanExtremities(grid)));
  }
  return grids;
}

std::vector<SolveRow> RunSolve(const BenchmarkOptions& options) {
  const Filming filming = FilmingOf(options);
  std::vector<SolveRow> rows;
  PrintNow(SolveHeader());
  for (int i = 0; i < options.SeedsOr(kNoisePeople); ++i) {
    rows.push_back(
        RunSolveTrial(VarietyTrialOf(options.from + i, options.SecondsOr(kNoiseSeconds), filming)));
    PrintNow(SolveLine(rows.back()));
  }
  return rows;
}

std::vector<ScoredTakes> RunTakes(const BenchmarkOptions& options,
                                  const std::vector<TakesFolder>& folders) {
  std::vector<ScoredTakes> all;
  for (const TakesFolder& folder : folders) {
    TellRemarks("benchmark", folder.remarks);
    PrintNow(fmt::format("\nrecorded takes, {}\n{}", folder.name, TakesHeader()));
    ScoredTakes& rows = all.emplace_back(ScoredTakes{folder.name, {}});
    for (const std::filesystem::path& take : folder.takes) {
      rows.takes.push_back(RunTakeTrial(take, options.FirstsOr(kTakeFirsts)));
      PrintNow(TakeLines(rows.takes.back()));
    }
    PrintNow(TakesSummaryText(rows) + ExtremityText(MeanExtremities(rows)));
  }
  return all;
}

}  // namespace mocap
