#include "tools/accuracy/evidence_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tools/report/report_page.h"

namespace mocap {
namespace {

std::string CrfText(const std::optional<int>& crf) { return crf ? std::to_string(*crf) : "none"; }

std::string ContrastText(const EvidenceKind& kind) {
  std::string text = kind.contrast > 0 ? fmt::format("{:.0f}", kind.contrast) : "full";
  if (kind.soft_shadows) text += ", soft shadows";
  if (kind.misled_share > 0) text += fmt::format(", {:.0f} % misled", 100 * kind.misled_share);
  return text;
}

std::string ErrorOrDash(double tracked_share, double error_mm) {
  return tracked_share > 0 ? fmt::format("{:.1f}", error_mm) : "–";
}

bool DifferInCamerasOnly(EvidenceKind a, const EvidenceKind& b) {
  return std::exchange(a.cameras, b.cameras) != b.cameras && a == b;
}

std::string RiseText(const std::optional<EvidenceRise>& rise) {
  if (!rise) return "\nNo kind was tracked that has more cameras in another line.\n";
  const bool is_lost = rise->mm() == std::numeric_limits<double>::infinity();
  return fmt::format(
      "\nThe largest rise of the error by more cameras: {}, from {} to {} cameras at a contrast of "
      "{} and crf {} (wanted: at most {:.0f} mm).\n",
      is_lost ? "nobody is tracked any more" : fmt::format("{:+.1f} mm", rise->mm()),
      rise->fewer.cameras, rise->more.cameras, ContrastText(rise->fewer), CrfText(rise->fewer.crf),
      kMostRise_mm);
}

bool IsWorseThanWithFewer(const EvidenceSummary& kind, std::span<const EvidenceSummary> kinds) {
  return std::ranges::any_of(kinds, [&kind](const EvidenceSummary& other) {
    return DifferInCamerasOnly(other.kind, kind.kind) && other.kind.cameras < kind.kind.cameras &&
           kind.error_mm() > other.error_mm() + kMostRise_mm;
  });
}

// The errors of one crf; the last series are those that rise.
Json LinesOf(const std::optional<int>& crf, std::span<const EvidenceSummary> kinds) {
  Json lines = Json::array(), x = Json::array(), rises = Json::array();
  for (const double contrast : kEvidenceContrasts) {
    Json errors = Json::array(), places = Json::array();
    for (const EvidenceSummary& kind : kinds) {
      if (kind.kind.contrast != contrast || kind.kind.crf != crf) continue;
      const auto place = std::ranges::find(kEvidenceCameras, kind.kind.cameras);
      places.push_back(place - kEvidenceCameras.begin());
      errors.push_back(kind.is_tracked() ? NumberOrNull(kind.error_mm()) : Json());
      if (!kind.is_tracked() || !IsWorseThanWithFewer(kind, kinds)) continue;
      x.push_back(places.back());
      rises.push_back(errors.back());
    }
    lines.push_back(Series(fmt::format("{}{:.0f}", lines.empty() ? "contrast " : "", contrast),
                           static_cast<int>(lines.size()), "line", errors, {{"x", places}}));
  }
  lines.push_back(Series(fmt::format("rises by more than {:.0f} mm", kMostRise_mm),
                         static_cast<int>(lines.size()), "crosses", rises, {{"x", x}}));
  return lines;
}

}  // namespace

std::vector<EvidenceSummary> SummarizeEvidence(std::span<const EvidenceRow> rows) {
  std::vector<EvidenceSummary> kinds;
  for (const EvidenceRow& first : rows) {
    const auto is_same = [&first](const auto& other) { return other.kind == first.kind; };
    if (std::ranges::any_of(kinds, is_same)) continue;
    std::vector<AccuracyRow> takes;
    double hull_shares = 0, unknown_shares = 0;
    for (const EvidenceRow& row : rows) {
      if (!is_same(row)) continue;
      takes.push_back(row.accuracy);
      hull_shares += row.hull_share;
      unknown_shares += row.unknown_share;
    }
    kinds.push_back({.kind = first.kind,
                     .accuracy = Summarize(takes),
                     .hull_share = hull_shares / static_cast<double>(takes.size()),
                     .unknown_share = unknown_shares / static_cast<double>(takes.size())});
  }
  return kinds;
}

std::optional<EvidenceRise> LargestRise(std::span<const EvidenceSummary> kinds) {
  std::optional<EvidenceRise> largest;
  for (const EvidenceSummary& fewer : kinds) {
    for (const EvidenceSummary& more : kinds) {
      if (!DifferInCamerasOnly(fewer.kind, more.kind) || more.kind.cameras < fewer.kind.cameras ||
          !fewer.is_tracked())
        continue;
      const EvidenceRise rise{fewer.kind, more.kind, fewer.error_mm(), more.error_mm()};
      if (!largest || rise.mm() > largest->mm()) largest = rise;
    }
  }
  return largest;
}

std::string EvidenceHeader() {
  return fmt::format("{:<20}{:>6}{:>9}  {:<8}{:>8}{:>6}{:>9}{:>11}{:>8}{:>11}\n", "contrast", "crf",
                     "cameras", "motion", "stature", "seed", "mean mm", "tracked %", "hull %",
                     "unknown %");
}

std::string EvidenceLine(const EvidenceRow& row) {
  return fmt::format("{:<20}{:>6}{:>9}  {:<8}{:>8.0f}{:>6}{:>9}{:>11.1f}{:>8.0f}{:>11.0f}\n",
                     ContrastText(row.kind), CrfText(row.kind.crf), row.kind.cameras,
                     row.accuracy.motion, row.accuracy.stature_mm, row.accuracy.seed,
                     ErrorOrDash(row.accuracy.tracked_share, row.accuracy.mpjpe_mm),
                     100 * row.accuracy.tracked_share, 100 * row.hull_share,
                     100 * row.unknown_share);
}

std::string EvidenceTable(std::span<const EvidenceRow> rows) {
  if (rows.empty()) return {};
  std::string text = "\n| contrast | crf |";
  for (const int cameras : kEvidenceCameras)
    text += fmt::format(" {} cameras: mean mm | tracked % | hull % | unknown % |", cameras);
  text += "\n|---|---|";
  for (std::size_t i = 0; i < kEvidenceCameras.size(); ++i) text += "---|---|---|---|";
  const std::vector<EvidenceSummary> kinds = SummarizeEvidence(rows);
  const EvidenceKind* last = nullptr;
  for (const EvidenceSummary& kind : kinds) {
    if (!last || !DifferInCamerasOnly(*last, kind.kind))
      text += fmt::format("\n| {} | {} |", ContrastText(kind.kind), CrfText(kind.kind.crf));
    last = &kind.kind;
    text += fmt::format(" {} | {:.0f} | {:.0f} | {:.0f} |",
                        ErrorOrDash(kind.accuracy.tracked_share, kind.accuracy.mpjpe_mm),
                        100 * kind.accuracy.tracked_share, 100 * kind.hull_share,
                        100 * kind.unknown_share);
  }
  return text + "\n" + RiseText(LargestRise(kinds));
}

std::string EvidenceMarkdown(std::span<const EvidenceRow> rows, double seconds) {
  if (rows.empty()) return {};
  return fmt::format(
             "\n## Weak evidence\nClothes differ from what is behind them by at most the contrast "
             "[of 256 grey values]. Pictures are coded by x264 at the crf. Misled cameras do not "
             "see "
             "the shirt or the trousers. {} takes of {:.0f} s. "
             "*Hull*\nis the volume that is carved, as a share of the hull of the true masks of "
             "the same cameras. *Unknown* is the share of unknown pixels where cameras show the "
             "person.\n\n[Mean error by number of cameras](evidence.html)\n",
             rows.size(), seconds) +
         EvidenceTable(rows);
}

std::string EvidenceHtml(std::span<const EvidenceRow> rows) {
  const std::vector<EvidenceSummary> kinds = SummarizeEvidence(rows);
  Json plots = Json::array(), names = Json::array();
  for (const int cameras : kEvidenceCameras) names.push_back(std::to_string(cameras));
  for (const std::optional<int>& crf : kEvidenceCrfs) {
    plots.push_back(
        {{"x", {{"label", fmt::format("cameras, crf {}", CrfText(crf))}, {"names", names}}},
         {"y", {{"label", "mm"}}},
         {"height", 110},
         {"series", LinesOf(crf, kinds)}});
  }
  return ReportHtml("Weak evidence", "mean error by number of cameras",
                    Json::array({Figure("Mean error", "by number of cameras", plots)}));
}

}  // namespace mocap
