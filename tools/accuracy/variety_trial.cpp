#include "tools/accuracy/variety_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/errors.h"
#include "drivers/virtual_studio/people/costume.h"
#include "drivers/virtual_studio/random.h"
#include "tools/report/extremity_text.h"

namespace mocap {
namespace {

constexpr std::array kVariedMotions = {"walk", "dance", "stand", "sit",    "run",
                                       "step", "jump",  "lie",   "gesture"};
constexpr double kWheelchairs = 0.07;  ///< As a share of the people.
constexpr double kLatestBegin_s = 8;
constexpr double kFoundLate_s = 0.5, kLostLong_s = 0.3;
constexpr std::size_t kWorst = 10;

struct Counts {
  std::size_t never = 0, late = 0, lost = 0, wrong = 0;
  double mean_mm = 0, worst_mm = 0;  ///< Of those who were found.
};

Counts CountOf(std::span<const VarietyRow> rows) {
  Counts counts;
  for (const VarietyRow& row : rows) {
    counts.never += row.found_s < 0;
    counts.late += row.found_s > kFoundLate_s;
    counts.lost += row.lost_s > kLostLong_s;
    counts.wrong += row.accuracy.longest_wrong_stretch > kLongestGlitch;
    counts.mean_mm += row.accuracy.mpjpe_mm;
    counts.worst_mm = std::max(counts.worst_mm, row.accuracy.mpjpe_mm);
  }
  counts.mean_mm /= static_cast<double>(std::max<std::size_t>(rows.size() - counts.never, 1));
  return counts;
}

// A person who was never found ranks last.
bool IsWorse(const VarietyRow& a, const VarietyRow& b) {
  if ((a.found_s < 0) != (b.found_s < 0)) return a.found_s < 0;
  return a.accuracy.mpjpe_mm > b.accuracy.mpjpe_mm;
}

/// The errors of a run, and all of its sets from this one on.
void AddRun(const Evaluation& evaluation, std::int64_t from, std::vector<ErrorsBySet>& runs,
            std::vector<std::int64_t>& sets) {
  const std::vector<PoseRow>& poses = evaluation.result.poses;
  ErrorsBySet& run = runs.emplace_back();
  for (const FrameError& error : evaluation.accuracy->frames) {
    const std::int64_t set = poses[static_cast<std::size_t>(error.pose)].frame;
    if (set >= from) run[set] = error;
  }
  sets.clear();
  for (const PoseRow& row : poses)
    if (row.frame >= from) sets.push_back(row.frame);
}

// A person whom one of the runs did not find was never found.
void TakeWorst(const AccuracyRow& run, AccuracyRow& worst) {
  const bool is_never = run.found_after < 0 || worst.found_after < 0;
  worst.found_after = is_never ? -1 : std::max(worst.found_after, run.found_after);
  worst.longest_loss = std::max(worst.longest_loss, run.longest_loss);
  worst.longest_wrong_stretch = std::max(worst.longest_wrong_stretch, run.longest_wrong_stretch);
}

std::string FoundText(const VarietyRow& row) {
  return row.found_s < 0 ? "never" : fmt::format("{:.2f}", row.found_s);
}

}  // namespace

std::vector<Filming> Filmings() {
  return {{.label = "30 Hz"},
          {.label = "10 Hz", .fps = 10},
          {.label = "four cameras", .cameras = 4},
          {.label = "eight cameras", .cameras = 8},
          {.label = "2 % covered by squares", .covered_share = 0.02}};
}

AccuracyTrial VarietyTrialOf(int number, double seconds, const Filming& filming) {
  const auto seed = static_cast<std::uint64_t>(number);
  AccuracyTrial trial;
  trial.studio.varied = true;
  trial.studio.seed = seed;
  const bool rolls =
      simulation::Random(simulation::Mix(seed, simulation::Tag("wheelchair"))).Uniform(0, 1) <
      kWheelchairs;
  trial.studio.motion = rolls ? "roll" : kVariedMotions[seed % kVariedMotions.size()];
  trial.studio.stature_mm =
      std::round(simulation::Random(simulation::Mix(seed, simulation::Tag("varied stature")))
                     .Uniform(1150, 1980));
  trial.studio.seconds = seconds;
  // In the middle of a motion: crouched, in the air, lying.
  trial.studio.begin_s = simulation::Random(simulation::Mix(seed, simulation::Tag("varied begin")))
                             .Uniform(0, kLatestBegin_s);
  trial.studio.fps = filming.fps;
  trial.studio.cameras = filming.cameras;
  trial.covered_share = filming.covered_share;
  return trial;
}

VarietyRow RunVarietyTrial(int number, double seconds, const Filming& filming, int firsts) {
  if (std::lround(seconds * filming.fps) < firsts)
    throw SetupError(fmt::format("--seconds: {} s at {} Hz have fewer than {} frame sets", seconds,
                                 filming.fps, firsts));
  const AccuracyTrial trial = VarietyTrialOf(number, seconds, filming);
  VarietyRow row{.accuracy = {},
                 .looks = simulation::Describe(
                     simulation::MakeCostume(trial.studio.seed, trial.studio.motion))};
  std::vector<ErrorsBySet> runs;
  std::vector<std::int64_t> sets;
  for (const TrialOutcome& outcome : RunTrialFrom(trial, firsts)) {
    const AccuracyRow run = RowOf(trial, outcome);
    if (runs.empty()) row.accuracy = run;
    TakeWorst(run, row.accuracy);
    AddRun(outcome.evaluation, firsts - 1, runs, sets);
  }
  row.score = ScoreFirsts(runs, sets);
  const PoseErrors mean = row.score.Mean().value_or(PoseErrors());
  row.accuracy.mpjpe_mm = mean.mean_mm;
  row.accuracy.p95_mm = mean.p95_mm;
  row.accuracy.angle_deg = mean.angle_deg;
  if (row.accuracy.found_after >= 0) row.found_s = row.accuracy.found_after / filming.fps;
  row.lost_s = row.accuracy.longest_loss / filming.fps;
  return row;
}

ExtremityAccuracy MeanExtremities(const VarietyGrid& grid) {
  std::vector<AccuracyRow> rows;
  for (const VarietyRow& row : grid.rows) rows.push_back(row.accuracy);
  return MeanExtremities(rows);
}

std::string VarietyHeader() {
  return fmt::format("{:>6} {:<7}{:>8}{:>9}{:>9}{:>9}{:>10}{:>9}{:>8}{:>7}  {}\n", "number",
                     "motion", "stature", "mean mm", "95 % mm", "degrees", "spread mm", "found s",
                     "lost s", "wrong", "wears");
}

std::string VarietyLine(const VarietyRow& row) {
  const AccuracyRow& a = row.accuracy;
  return fmt::format("{:>6} {:<7}{:>8.0f}{:>9.1f}{:>9.1f}{:>9.2f}{:>10.1f}{:>9}{:>8.2f}{:>7}  {}\n",
                     a.seed, a.motion, a.stature_mm, a.mpjpe_mm, a.p95_mm, a.angle_deg,
                     row.score.spread_mm(), FoundText(row), row.lost_s, a.longest_wrong_stretch,
                     row.looks);
}

std::string VarietySummaryText(std::span<const VarietyRow> rows) {
  const Counts counts = CountOf(rows);
  return fmt::format(
      "{} varied people: {} never found, {} found after more than {} s, {} lost for more than {} "
      "s, {} tracked in a wrong pose; {:.1f} mm in the mean ({:.1f} mm the worst)\n",
      rows.size(), counts.never, counts.late, kFoundLate_s, counts.lost, kLostLong_s, counts.wrong,
      counts.mean_mm, counts.worst_mm);
}

std::string VarietyMarkdown(std::span<const VarietyGrid> grids) {
  if (grids.empty()) return {};
  std::string text = fmt::format(
      "\n## People of all kinds\nBuild, hair, hat, clothes and loads are drawn at random, and each "
      "person is filmed in several ways.\n*Late* is more than {} s until found, *lost* more than "
      "{} s without tracking afterwards.\n\n| filmed | people | never found | late | lost | wrong "
      "| mean mm | worst mm |\n|---|---|---|---|---|---|---|---|\n",
      kFoundLate_s, kLostLong_s);
  for (const auto& [filming, rows] : grids) {
    const Counts counts = CountOf(rows);
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {:.1f} | {:.1f} |\n", filming.label,
                        rows.size(), counts.never, counts.late, counts.lost, counts.wrong,
                        counts.mean_mm, counts.worst_mm);
  }
  for (const auto& [filming, rows] : grids) {
    text += fmt::format(
        "\nThe worst at {}:\n\n| number | motion | stature mm | mean mm | found s | lost s | wears "
        "|\n|---|---|---|---|---|---|---|\n",
        filming.label);
    std::vector<VarietyRow> worst(rows.begin(), rows.end());
    std::ranges::sort(worst, IsWorse);
    worst.resize(std::min(worst.size(), kWorst));
    for (const VarietyRow& row : worst)
      text += fmt::format("| {} | {} | {:.0f} | {:.1f} | {} | {:.2f} | {} |\n", row.accuracy.seed,
                          row.accuracy.motion, row.accuracy.stature_mm, row.accuracy.mpjpe_mm,
                          FoundText(row), row.lost_s, row.looks);
  }
  for (const VarietyGrid& grid : grids)
    text += ExtremityMarkdown("### Hands, feet and head at " + grid.filming.label,
                              MeanExtremities(grid));
  return text;
}

}  // namespace mocap
