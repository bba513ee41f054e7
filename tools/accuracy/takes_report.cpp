#include <fmt/format.h>

#include <algorithm>

#include "tools/accuracy/takes_trial.h"
#include "tools/report/extremity_text.h"

namespace mocap {
namespace {

/// Over the people of a folder.
struct TakesSummary {
  int people = 0, never = 0, switches = 0, stray_sets = 0;
  PoseErrors mean;
  double tracked_share = 0, spread_mm = 0, worst_spread_mm = 0;
};

TakesSummary SummaryOf(const ScoredTakes& rows) {
  TakesSummary sum;
  for (const ScoredTake& take : rows.takes) {
    sum.stray_sets += take.stray_sets;
    for (const TakePerson& person : take.people) {
      ++sum.people;
      sum.switches += person.switches;
      sum.tracked_share += person.score.tracked_share();
      const std::optional<PoseErrors> errors = person.score.Mean();
      if (!errors) ++sum.never;
      if (!errors) continue;
      sum.mean.mean_mm += errors->mean_mm;
      sum.mean.p95_mm += errors->p95_mm;
      sum.mean.angle_deg += errors->angle_deg;
      sum.spread_mm += person.score.spread_mm();
      sum.worst_spread_mm = std::max(sum.worst_spread_mm, person.score.spread_mm());
    }
  }
  const double found = std::max(1, sum.people - sum.never);
  sum.mean = {sum.mean.mean_mm / found, sum.mean.p95_mm / found, sum.mean.angle_deg / found};
  sum.spread_mm /= found;
  sum.tracked_share /= std::max(1, sum.people);
  return sum;
}

/// Numbers of a person or of nobody, between separators.
std::string FiguresOf(const std::optional<PoseErrors>& errors, std::string_view format,
                      std::string_view nothing) {
  if (!errors) return std::string(nothing);
  return fmt::format(fmt::runtime(format), errors->mean_mm, errors->p95_mm, errors->angle_deg);
}

}  // namespace

ExtremityAccuracy MeanExtremities(const ScoredTakes& rows) {
  std::vector<ExtremityAccuracy> people;
  for (const ScoredTake& take : rows.takes)
    for (const TakePerson& person : take.people) people.push_back(person.extremities);
  return MeanOf(people);
}

std::string TakesHeader() {
  return fmt::format("{:<32}{:>9}{:>9}{:>9}{:>10}{:>6}{:>11}{:>10}\n", "take", "mean mm", "95 % mm",
                     "degrees", "spread mm", "sets", "tracked %", "switches");
}

std::string TakeLines(const ScoredTake& row) {
  std::string text;
  for (const auto& [name, score, switches, extremities] : row.people) {
    text += fmt::format(
        "{:<32}{}{:>10.1f}{:>6}{:>11.2f}{:>10}\n", name,
        FiguresOf(score.Mean(), "{:>9.1f}{:>9.1f}{:>9.2f}", "    never tracked          "),
        score.spread_mm(), score.sets, 100 * score.tracked_share(), switches);
  }
  return text;
}

std::string TakesSummaryText(const ScoredTakes& rows) {
  const TakesSummary sum = SummaryOf(rows);
  return fmt::format(
      "{}: {} people, {} never tracked: {:.1f} mm in the mean, 95 % below {:.1f} mm, {:.2f} "
      "degrees; spread over the first sets {:.1f} mm in the mean ({:.1f} mm the worst); tracked "
      "{:.2f} %; in all runs {} switches, phantoms in {} sets\n",
      rows.folder, sum.people, sum.never, sum.mean.mean_mm, sum.mean.p95_mm, sum.mean.angle_deg,
      sum.spread_mm, sum.worst_spread_mm, 100 * sum.tracked_share, sum.switches, sum.stray_sets);
}

std::string TakesMarkdown(const std::vector<ScoredTakes>& folders, int firsts) {
  if (folders.empty()) return {};
  std::string text = fmt::format(
      "\n## Recorded takes\nEach take is tracked {} times, from another first set each time, and "
      "scored in the sets that all runs track.\nErrors are means over the runs; *spread* is the "
      "largest less the smallest mean error of a run.\n",
      firsts);
  for (const ScoredTakes& rows : folders) {
    text += fmt::format(
        "\n{}\n| take | mean mm | 95 % below mm | degrees | spread mm | sets | tracked % | "
        "switches |\n|---|---|---|---|---|---|---|---|\n",
        TakesSummaryText(rows));
    for (const ScoredTake& take : rows.takes) {
      for (const auto& [name, score, switches, extremities] : take.people)
        text += fmt::format("| {} | {} | {:.1f} | {} | {:.2f} | {} |\n", name,
                            FiguresOf(score.Mean(), "{:.1f} | {:.1f} | {:.2f}", "never | | "),
                            score.spread_mm(), score.sets, 100 * score.tracked_share(), switches);
    }
    text += ExtremityMarkdown("### Hands, feet and head: " + rows.folder, MeanExtremities(rows));
  }
  return text;
}

}  // namespace mocap
