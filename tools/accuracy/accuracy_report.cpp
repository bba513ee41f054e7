#include "tools/accuracy/accuracy_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "tools/report/extremity_text.h"
#include "tools/report/report_page.h"

namespace mocap {
namespace {

// Without tracking there is no such time.
std::string UntilFound(const PeopleRow& row) {
  return row.never_found > 0 ? "never" : fmt::format("{:.1f}", row.slowest_found_s);
}

std::string GridTable(const std::vector<AccuracyRow>& rows) {
  std::string text =
      "\n## Take by take\n\n| motion | stature mm | seed | mean mm | 95 % below mm | degrees | "
      "lengths mm | tracked % | head % | acquired in | wrong |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const AccuracyRow& row : rows) {
    text += fmt::format(
        "| {} | {:.0f} | {} | {:.1f} | {:.1f} | {:.2f} | {:.1f} | {:.1f} | {:.1f} | {} | {} |\n",
        row.motion, row.stature_mm, row.seed, row.mpjpe_mm, row.p95_mm, row.angle_deg,
        row.length_error_mm, 100 * row.tracked_share, 100 * row.head_found_share,
        row.acquisition_frames, row.longest_wrong_stretch);
  }
  return text;
}

std::string PeopleTable(const AccuracyBenchmark& benchmark) {
  std::string text = fmt::format(
      "\n## Several people\nTakes of {:.0f} s. *Found* is the share of frame sets in which a "
      "person was tracked while four cameras saw the whole person.\n*Until found* is the longest "
      "time until a person was found, and *lost* the longest time that a person was not tracked "
      "afterwards.\n*Switches* counts tracks that changed from one person to another. *Phantoms* "
      "is the time of tracks without a person, or of a person who has a track already.\n\n{}\n| "
      "motion | people | seed | mean mm | worst person mm | found % | until found s | lost s | "
      "switches | phantoms s |\n|---|---|---|---|---|---|---|---|---|---|\n",
      benchmark.people_seconds, PeopleSummaryText(benchmark.people));
  for (const PeopleRow& row : benchmark.people) {
    text += fmt::format("| {} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {} | {:.1f} | {} | {:.1f} |\n",
                        row.motion, row.people, row.seed, row.mpjpe_mm, row.worst_person_mm,
                        100 * row.found_share, UntilFound(row), row.longest_lost_s, row.switches,
                        row.phantom_s);
  }
  return text;
}

}  // namespace

std::string SweepTable(const AccuracySweep& sweep) {
  std::string text = fmt::format(
      "\n| {} | mean mm | worst take mm | 95 % below mm | degrees | lengths mm | tracked % |\n"
      "|---|---|---|---|---|---|---|\n",
      sweep.what);
  for (const auto& [label, summary] : sweep.steps) {
    text += fmt::format("| {} | {:.1f} | {:.1f} | {:.1f} | {:.2f} | {:.0f} | {:.1f} |\n", label,
                        summary.mpjpe_mm, summary.worst_mpjpe_mm, summary.p95_mm, summary.angle_deg,
                        summary.length_error_mm, 100 * summary.tracked_share);
  }
  return text;
}

std::string AccuracyHeader() {
  return fmt::format("{:<8}{:>9}{:>6}{:>9}{:>9}{:>9}{:>9}{:>10}{:>8}{:>10}{:>8}\n", "motion",
                     "stature", "seed", "mean mm", "95 % mm", "degrees", "lengths", "tracked %",
                     "head %", "acquired", "wrong");
}

std::string AccuracyLine(const AccuracyRow& row) {
  return fmt::format(
      "{:<8}{:>9.0f}{:>6}{:>9.1f}{:>9.1f}{:>9.2f}{:>9.1f}{:>10.1f}{:>8.1f}{:>10}{:>8}\n",
      row.motion, row.stature_mm, row.seed, row.mpjpe_mm, row.p95_mm, row.angle_deg,
      row.length_error_mm, 100 * row.tracked_share, 100 * row.head_found_share,
      row.acquisition_frames, row.longest_wrong_stretch);
}

std::string AccuracySummaryText(const AccuracySummary& summary) {
  return fmt::format(
      "{} takes: {:.1f} mm in the mean ({:.1f} mm the worst), 95 % below {:.1f} mm, {:.2f} "
      "degrees, part lengths {:.1f} mm off;\ntracked {:.2f} % (lost in {} takes), head found "
      "{:.2f} %, sizes settled after {:.0f} sets (at most {}); tracked with a mean error above "
      "{:.0f} mm for more than {} sets in {} takes\n",
      summary.takes, summary.mpjpe_mm, summary.worst_mpjpe_mm, summary.p95_mm, summary.angle_deg,
      summary.length_error_mm, 100 * summary.tracked_share, summary.takes_with_loss,
      100 * summary.head_found_share, summary.median_acquisition_frames,
      summary.most_acquisition_frames, kWrongMm, kLongestGlitch, summary.takes_with_wrong_stretch);
}

std::string PeopleHeader() {
  return fmt::format("{:<8}{:>7}{:>6}{:>9}{:>9}{:>9}{:>9}{:>8}{:>10}{:>10}\n", "motion", "people",
                     "seed", "mean mm", "worst mm", "found %", "until s", "lost s", "switches",
                     "phantom s");
}

std::string PeopleLine(const PeopleRow& row) {
  return fmt::format("{:<8}{:>7}{:>6}{:>9.1f}{:>9.1f}{:>9.1f}{:>9}{:>8.1f}{:>10}{:>10.1f}\n",
                     row.motion, row.people, row.seed, row.mpjpe_mm, row.worst_person_mm,
                     100 * row.found_share, UntilFound(row), row.longest_lost_s, row.switches,
                     row.phantom_s);
}

std::string PeopleSummaryText(std::span<const PeopleRow> rows) {
  double mpjpe_mm = 0, worst_mm = 0, found = 0, lost_s = 0, phantom_s = 0;
  int switches = 0, never_found = 0;
  for (const PeopleRow& row : rows) {
    const double weight = 1.0 / static_cast<double>(rows.size());
    mpjpe_mm += weight * row.mpjpe_mm;
    found += weight * row.found_share;
    worst_mm = std::max(worst_mm, row.worst_person_mm);
    lost_s = std::max(lost_s, row.longest_lost_s);
    phantom_s += row.phantom_s;
    switches += row.switches;
    never_found += row.never_found;
  }
  return fmt::format(
      "{} takes of several people: {:.1f} mm in the mean ({:.1f} mm the worst person), found "
      "{:.2f} "
      "% of the time, lost for {:.1f} s at the longest;\n{} switches, phantoms for {:.1f} s in "
      "all, "
      "{} never found\n",
      rows.size(), mpjpe_mm, worst_mm, 100 * found, lost_s, switches, phantom_s, never_found);
}

std::string AccuracyMarkdown(const AccuracyBenchmark& benchmark) {
  std::string text = fmt::format(
      "# Accuracy on simulated people\n\nWritten by `mocap benchmark`: takes of {:.0f} "
      "s, six VGA cameras and voxels of 25 mm unless stated otherwise. Errors are over 14 "
      "points\nand 8 angles, as in `mocap evaluate`; *wrong* is the longest run of tracked frame "
      "sets with a mean error above {:.0f} mm.\n\n",
      benchmark.seconds, kWrongMm);
  if (!benchmark.grid.empty())
    text += AccuracySummaryText(Summarize(benchmark.grid)) +
            ExtremityMarkdown("## Hands, feet and head", MeanExtremities(benchmark.grid));
  if (!benchmark.sweeps.empty()) {
    text +=
        "\n## What makes it worse\nEach line is the mean over walking, dancing and sitting "
        "down.\n\n[Mean error along each sweep](accuracy.html)\n";
    for (const AccuracySweep& sweep : benchmark.sweeps) text += SweepTable(sweep);
  }
  if (!benchmark.studios.steps.empty()) {
    text +=
        fmt::format(
            "\n## Studios\nEach line differs from the first in what it says. Takes of {:.0f} s.\n",
            benchmark.studio_seconds) +
        SweepTable(benchmark.studios);
  }
  if (!benchmark.people.empty()) text += PeopleTable(benchmark);
  if (!benchmark.grid.empty()) text += GridTable(benchmark.grid);
  return text;
}

std::string AccuracySweepsHtml(std::span<const AccuracySweep> sweeps) {
  Json plots = Json::array();
  for (const AccuracySweep& sweep : sweeps) {
    Json names = Json::array(), mean = Json::array(), p95 = Json::array();
    for (const auto& [label, summary] : sweep.steps) {
      names.push_back(label);
      mean.push_back(NumberOrNull(summary.mpjpe_mm));
      p95.push_back(NumberOrNull(summary.p95_mm));
    }
    plots.push_back(
        {{"x", {{"label", sweep.what}, {"names", names}, {"first", 0}}},
         {"y", {{"label", "mm"}}},
         {"height", 110},
         {"series", {Series("mean", 0, "line", mean), Series("95 % below", 1, "line", p95)}}});
  }
  return ReportHtml("What makes it worse", "mean over walking, dancing and sitting down",
                    Json::array({Figure("Mean error", "along each sweep", plots)}));
}

}  // namespace mocap
