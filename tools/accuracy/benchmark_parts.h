// The parts of a benchmark. Each prints its lines while it runs.
#pragma once

#include <string>
#include <vector>

#include "tools/accuracy/accuracy_benchmark.h"
#include "tools/accuracy/benchmark_options.h"
#include "tools/accuracy/evidence_trial.h"
#include "tools/accuracy/noise_trial.h"
#include "tools/accuracy/paper_trial.h"
#include "tools/accuracy/solve_trial.h"
#include "tools/accuracy/takes_trial.h"
#include "tools/accuracy/variety_trial.h"

namespace mocap {

/// Prints at once, also into a pipe.
void PrintNow(const std::string& text);

/// Tracks every motion of every stature with every seed.
std::vector<AccuracyRow> RunGrid(const BenchmarkOptions& options);
/// Makes one thing worse step by step, for each such part that is wanted.
std::vector<AccuracySweep> RunSweeps(const BenchmarkOptions& options);
AccuracySweep RunStudios(const BenchmarkOptions& options);
std::vector<PeopleRow> RunPeople(const BenchmarkOptions& options);
std::vector<VarietyGrid> RunVariety(const BenchmarkOptions& options);
/// Tracks varied people live, and solves the same sets.
std::vector<SolveRow> RunSolve(const BenchmarkOptions& options);
std::vector<PaperRow> RunPaper(const BenchmarkOptions& options);
std::vector<EvidenceRow> RunEvidence(const BenchmarkOptions& options);
/// Measures the noise of the evidence at the true poses of varied people.
std::vector<NoiseTake> RunNoise(const BenchmarkOptions& options);
/// Tracks recorded takes. @param folders  as FoldersOfTakes returns them.
std::vector<ScoredTakes> RunTakes(const BenchmarkOptions& options,
                                  const std::vector<TakesFolder>& folders);

}  // namespace mocap
