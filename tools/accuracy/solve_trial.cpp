#include "tools/accuracy/solve_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <thread>
#include <utility>
#include <vector>

#include "config/load_config.h"
#include "tools/results/result_sink.h"
#include "tools/solving/solve_studio.h"
#include "tools/solving/work_folder.h"

namespace mocap {
namespace {

/// Somebody whose mean error is this much greater than live got worse.
constexpr double kWorse_mm = 5;

SolveRow::Side SideOf(const AccuracyTrial& trial, const TrialOutcome& outcome) {
  const Evaluation& evaluation = outcome.evaluation;
  SolveRow::Side side{.accuracy = RowOf(trial, outcome)};
  side.jitter_mm = evaluation.jitter_mm.value_or(0);
  if (evaluation.certainty)
    side.within_two_deviations =
        evaluation.certainty->check ? evaluation.certainty->check->within_two_deviations.value_or(0)
                                    : 0;
  return side;
}

double MeanOf(std::span<const SolveRow> rows, auto value) {
  double sum = 0;
  for (const SolveRow& row : rows) sum += value(row);
  return sum / static_cast<double>(std::max<std::size_t>(1, rows.size()));
}

std::string SideMarkdown(std::span<const SolveRow> rows, const char* name,
                         SolveRow::Side SolveRow::*side) {
  const auto mean = [&](double AccuracyRow::*figure) {
    return MeanOf(rows, [&](const SolveRow& row) { return (row.*side).accuracy.*figure; });
  };
  const auto is_wrong = [&](const SolveRow& row) {
    return (row.*side).accuracy.longest_wrong_stretch > kLongestGlitch;
  };
  return fmt::format(
      "| {} | {:.1f} | {:.1f} | {:.2f} | {} | {:.1f} | {:.0f} % |\n", name,
      mean(&AccuracyRow::mpjpe_mm), mean(&AccuracyRow::p95_mm), mean(&AccuracyRow::angle_deg),
      std::ranges::count_if(rows, is_wrong),
      MeanOf(rows, [&](const SolveRow& row) { return (row.*side).jitter_mm; }),
      100 * MeanOf(rows, [&](const SolveRow& row) { return (row.*side).within_two_deviations; }));
}

}  // namespace

SolveRow RunSolveTrial(const AccuracyTrial& trial) {
  const WorkFolder work;
  ResultSink live(KeptPeople::kFirst, false);
  const Solved solved =
      SolveStudio(OpenTrial(trial), LoadBodyTable(trial.body),
                  {.voxel_mm = trial.voxel_mm,
                   .work = work.path(),
                   .mark = "trial",
                   .jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency())),
                   .live = &live});
  const TrialOutcome before = OutcomeOf(trial, live.result());
  const TrialOutcome after =
      OutcomeOf(trial, solved.people.empty() ? Result() : solved.people.begin()->second);
  return {SideOf(trial, before), SideOf(trial, after),
          before.evaluation.true_jitter_mm.value_or(0)};
}

std::string SolveHeader() {
  return fmt::format("{:>6} {:<8}{:>8} | {:>7}{:>7}{:>7}{:>6}{:>7} | {:>7}{:>7}{:>7}{:>6}{:>7}\n",
                     "number", "motion", "stature", "live mm", "95 %", "deg", "wrong", "jitter",
                     "solved", "95 %", "deg", "wrong", "jitter");
}

std::string SolveLine(const SolveRow& row) {
  const AccuracyRow& live = row.live.accuracy;
  std::string text = fmt::format("{:>6} {:<8}{:>8.0f}", live.seed, live.motion, live.stature_mm);
  for (const SolveRow::Side* side : {&row.live, &row.solved}) {
    const AccuracyRow& a = side->accuracy;
    text += fmt::format(" | {:>7.1f}{:>7.1f}{:>7.2f}{:>6}{:>7.1f}", a.mpjpe_mm, a.p95_mm,
                        a.angle_deg, a.longest_wrong_stretch, side->jitter_mm);
  }
  return text + "\n";
}

std::string SolveTable(std::span<const SolveRow> rows) {
  if (rows.empty()) return {};
  std::string worse;
  for (const SolveRow& row : rows) {
    const double by_mm = row.solved.accuracy.mpjpe_mm - row.live.accuracy.mpjpe_mm;
    if (by_mm > kWorse_mm) worse += fmt::format(" {} ({:+.1f})", row.live.accuracy.seed, by_mm);
  }
  return fmt::format(
             "\n## Live and solved\n{} varied people. The true motion has a jitter of {:.1f} mm.\n"
             "\n|  | mean mm | 95 % mm | degrees | wrong | jitter mm | within two deviations |\n"
             "|---|---|---|---|---|---|---|\n",
             rows.size(), MeanOf(rows, [](const SolveRow& row) { return row.true_jitter_mm; })) +
         SideMarkdown(rows, "live", &SolveRow::live) +
         SideMarkdown(rows, "solved", &SolveRow::solved) +
         fmt::format("\nWorse by more than {:.0f} mm:{}\n", kWorse_mm,
                     worse.empty() ? " nobody" : worse);
}

}  // namespace mocap
