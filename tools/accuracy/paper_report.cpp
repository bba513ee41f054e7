#include "tools/accuracy/paper_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace mocap {
namespace {

/// Takes with the same truth and rate.
using Scores = std::vector<PaperScore>;

Scores ScoresOf(std::span<const PaperRow> rows, std::size_t truth, std::size_t rate) {
  Scores scores;
  for (const PaperRow& row : rows) scores.push_back(row.scores[truth][rate]);
  return scores;
}

std::size_t CountAcquired(const Scores& scores) {
  return static_cast<std::size_t>(std::ranges::count_if(scores, &PaperScore::acquired));
}

// Over the acquired takes; not a number without any.
double MeanOver(const Scores& scores, double PaperScore::*member) {
  double sum = 0;
  for (const PaperScore& score : scores) sum += score.acquired ? score.*member : 0;
  return sum / static_cast<double>(CountAcquired(scores));
}

double Deviation(const Scores& scores) {
  const double mean_mm = MeanOver(scores, &PaperScore::mean_mm);
  Scores squares = scores;
  for (PaperScore& score : squares) score.mean_mm = std::pow(score.mean_mm - mean_mm, 2);
  return std::sqrt(MeanOver(squares, &PaperScore::mean_mm));
}

std::string ErrorCell(const Scores& scores) {
  const std::size_t acquired = CountAcquired(scores);
  if (acquired == 0) return "– (0)";
  const double mean_mm = MeanOver(scores, &PaperScore::mean_mm);
  if (acquired == 1) return fmt::format("{:.0f} (1)", mean_mm);
  return fmt::format("{:.0f} ± {:.0f} ({})", mean_mm, Deviation(scores), acquired);
}

std::string MotionCells(const Scores& scores) {
  double tracked = 0;
  for (const PaperScore& score : scores)
    tracked += score.tracked_share / static_cast<double>(scores.size());
  const std::size_t acquired = CountAcquired(scores);
  if (acquired == 0) return fmt::format(" 0 | – | – | – | {:.0f} |", 100 * tracked);
  return fmt::format(" {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} |", acquired,
                     MeanOver(scores, &PaperScore::mean_mm),
                     MeanOver(scores, &PaperScore::median_mm),
                     100 * MeanOver(scores, &PaperScore::head_share), 100 * tracked);
}

std::string MotionLine(const std::string& name, std::span<const PaperRow> rows) {
  std::string text = fmt::format("| {} |", name);
  for (std::size_t rate = 0; rate < kPaperSteps.size(); ++rate)
    text += MotionCells(ScoresOf(rows, static_cast<std::size_t>(PaperTruth::kNothing), rate));
  return text + "\n";
}

std::string MotionTable(std::span<const PaperRow> rows) {
  std::string text =
      "\n| motion | 30 Hz: acquired | mean mm | median mm | head % | tracked % | 10 Hz: acquired | "
      "mean mm | median mm | head % | tracked % |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  std::vector<std::string> motions;
  for (const PaperRow& row : rows) {
    if (std::ranges::find(motions, row.motion) == motions.end()) motions.push_back(row.motion);
  }
  for (const std::string& motion : motions) {
    std::vector<PaperRow> of_motion(rows.begin(), rows.end());
    std::erase_if(of_motion, [&](const PaperRow& row) { return row.motion != motion; });
    text += MotionLine(motion, of_motion);
  }
  return text + MotionLine("all", rows);
}

std::string ErrorText(const PaperScore& score) {
  return score.acquired ? fmt::format("{:.0f}", score.mean_mm) : "never";
}

}  // namespace

std::string PaperHeader() {
  return fmt::format("{:<8}{:>9}{:>6}{:>15}{:>7}{:>13}{:>7}{:>17}{:>7}\n", "motion", "stature",
                     "seed", "nothing 30 Hz", "10 Hz", "start 30 Hz", "10 Hz", "and parts 30 Hz",
                     "10 Hz");
}

std::string PaperLine(const PaperRow& row) {
  const auto& [nothing, start, parts] = row.scores;
  return fmt::format("{:<8}{:>9.0f}{:>6}{:>15}{:>7}{:>13}{:>7}{:>17}{:>7}\n", row.motion,
                     row.stature_mm, row.seed, ErrorText(nothing[0]), ErrorText(nothing[1]),
                     ErrorText(start[0]), ErrorText(start[1]), ErrorText(parts[0]),
                     ErrorText(parts[1]));
}

std::string PaperTables(std::span<const PaperRow> rows) {
  if (rows.empty()) return {};
  std::string text = "\n| true | 30 Hz | 10 Hz |\n|---|---|---|\n";
  for (std::size_t truth = 0; truth < kPaperTruthNames.size(); ++truth) {
    text += fmt::format("| {} |", kPaperTruthNames[truth]);
    for (std::size_t rate = 0; rate < kPaperSteps.size(); ++rate)
      text += fmt::format(" {} |", ErrorCell(ScoresOf(rows, truth, rate)));
    text += "\n";
  }
  return text + MotionTable(rows);
}

std::string PaperMarkdown(std::span<const PaperRow> rows, double seconds) {
  if (rows.empty()) return {};
  return fmt::format(
             "\n## The paper's tracker with true stages\n{} takes of {:.0f} s; 10 Hz is every "
             "third frame. A cell gives the mean error over 14 points [mm] ± its standard "
             "deviation\nbetween takes, and in brackets the number of takes acquired. The second "
             "table has nothing replaced by truth; *head* is within {:.0f} mm,\nand *tracked* "
             "counts from the first second on.\n",
             rows.size(), seconds, kHeadFoundMm) +
         PaperTables(rows);
}

}  // namespace mocap
