#include "tools/report/people_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "drivers/printable_text.h"
#include "tools/report/people_text.h"
#include "tools/report/report.h"
#include "tools/report/report_sections.h"
#include "tools/report/report_views.h"
#include "tools/report/svg_plot.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

constexpr int kColors = 8;

int ColorOf(std::size_t person) { return static_cast<int>(person % kColors); }

constexpr const char* kNothing = "–";  ///< Shown for a figure without frames.

std::string FoundPercent(const FollowedTruth& followed) {
  if (followed.covered == 0) return kNothing;
  return fmt::format("{:.1f}", 100.0 * followed.found_covered / followed.covered);
}

std::string ErrorText(const FollowedTruth& followed) {
  return followed.found > 0 ? fmt::format("{:.1f}", followed.mean_mm) : kNothing;
}

/// First and last frame over all people.
std::pair<double, double> PeopleFrameRange(const PeopleEvaluation& evaluation) {
  std::int64_t first = std::numeric_limits<std::int64_t>::max(), last = 0;
  for (const TrackedPerson& person : evaluation.people) {
    if (person.evaluation.result.poses.empty()) continue;
    first = std::min(first, person.evaluation.result.poses.front().frame);
    last = std::max(last, person.evaluation.result.poses.back().frame);
  }
  return {static_cast<double>(std::min(first, last)), static_cast<double>(last + 1)};
}

std::string Swatch(std::size_t person) {
  return fmt::format("<i class=\"swatch\" style=\"background:var(--c{})\"></i>", ColorOf(person));
}

std::string PeopleTiles(const PeopleEvaluation& evaluation) {
  std::string tiles =
      "<div class=\"tiles\">" + Tile("Tracked people", std::to_string(evaluation.people.size()), "",
                                     evaluation.truth.empty()
                                         ? "the take has no truth"
                                         : fmt::format("{} were there", evaluation.truth.size()));
  if (!evaluation.truth.empty()) {
    const FollowedTruth& sum = evaluation.sum;
    tiles += Tile("Error of 14 points", ErrorText(sum), sum.found > 0 ? " mm" : "",
                  "mean over all people found") +
             Tile("Found while covered", FoundPercent(sum), sum.covered > 0 ? " %" : "",
                  fmt::format("of {}", Counted(sum.covered, "frame"))) +
             Tile("Switches", std::to_string(sum.switches), "", "tracks that changed person") +
             Tile("Phantom frames", std::to_string(evaluation.phantom_frames), "",
                  "tracks without a person") +
             Tile("Duplicate frames", std::to_string(evaluation.duplicate_frames), "",
                  "second tracks of the same person");
  }
  return tiles + "</div>\n";
}

/// Consecutive frames in the same state.
struct Stretch {
  CaptureState state;
  std::int64_t first, last;
};

std::vector<Stretch> StretchesOf(const std::vector<PoseRow>& poses) {
  std::vector<Stretch> stretches;
  for (const PoseRow& row : poses) {
    const bool goes_on = !stretches.empty() && stretches.back().state == row.state &&
                         stretches.back().last + 1 == row.frame;
    if (goes_on) {
      stretches.back().last = row.frame;
    } else {
      stretches.push_back({row.state, row.frame, row.frame});
    }
  }
  return stretches;
}

/// A band of states for each person, over the take's frames.
std::string Timelines(const PeopleEvaluation& evaluation) {
  const auto [first, last] = PeopleFrameRange(evaluation);
  const double width = 1000 / std::max(1.0, last - first);
  std::string html;
  for (std::size_t i = 0; i < evaluation.people.size(); ++i) {
    const TrackedPerson& person = evaluation.people[i];
    html += fmt::format(
        "<p class=\"key\">{}{}</p><svg class=\"timeline\" viewBox=\"0 0 1000 26\" "
        "preserveAspectRatio=\"none\">",
        Swatch(i), EscapeHtml(person.name));
    for (const Stretch& stretch : StretchesOf(person.evaluation.result.poses)) {
      html += fmt::format(
          "<rect class=\"{0}\" x=\"{1:.2f}\" width=\"{2:.2f}\" height=\"26\"><title>{0}: frames "
          "{3} to {4}</title></rect>",
          kCaptureStateNames[static_cast<std::size_t>(stretch.state)],
          width * (static_cast<double>(stretch.first) - first),
          width * static_cast<double>(stretch.last + 1 - stretch.first), stretch.first,
          stretch.last);
    }
    html += "</svg>";
  }
  html += "<p class=\"key\">";
  for (const std::string_view state : kCaptureStateNames) {
    html += fmt::format("<span><i class=\"{0}\"></i>{0}</span>", state);
  }
  return html + fmt::format("<span>frames {:.0f} to {:.0f}</span></p>\n", first, last - 1);
}

std::string TrackedRows(const PeopleEvaluation& evaluation) {
  std::string html =
      "<h3>Tracked people</h3><table><tr><th>tracked</th><th class=\"n\">frames</th><th "
      "class=\"n\">fit mm</th><th class=\"n\">stature mm</th><th class=\"is\">true "
      "person</th><th class=\"n\">error mm</th><th class=\"n\">phantom</th><th "
      "class=\"n\">duplicate</th></tr>";
  for (std::size_t i = 0; i < evaluation.people.size(); ++i) {
    const TrackedPerson& person = evaluation.people[i];
    const Evaluation& one = person.evaluation;
    const bool is_scored = one.accuracy && !one.accuracy->frames.empty();
    html += fmt::format(
        "<tr><td>{}{}</td><td class=\"n\">{}</td><td class=\"n\">{:.1f}</td><td "
        "class=\"n\">{:.0f}</td><td class=\"is\">{}</td><td class=\"n\">{}</td><td "
        "class=\"n\">{}</td><td class=\"n\">{}</td></tr>",
        Swatch(i), EscapeHtml(person.name), one.result.poses.size(), one.mean_residual_mm,
        one.result.body.stature_mm,
        person.true_person < 0
            ? kNothing
            : EscapeHtml(evaluation.truth[static_cast<std::size_t>(person.true_person)].name),
        is_scored ? fmt::format("{:.1f}", one.accuracy->distance_mm.mean) : kNothing,
        person.phantom_frames, person.duplicate_frames);
  }
  return html + "</table>\n";
}

std::string TrueRows(const PeopleEvaluation& evaluation) {
  if (evaluation.truth.empty()) return {};
  std::string html =
      "<h3>True people</h3><table><tr><th>true</th><th class=\"n\">frames</th><th "
      "class=\"n\">found</th><th class=\"n\">covered</th><th class=\"n\">found while covered "
      "%</th><th class=\"n\">switches</th><th class=\"n\">error mm</th></tr>";
  const auto add = [&](const std::string& name, const FollowedTruth& followed) {
    html += fmt::format(
        "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td "
        "class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>",
        EscapeHtml(name), followed.frames, followed.found, followed.covered, FoundPercent(followed),
        followed.switches, ErrorText(followed));
  };
  for (std::size_t i = 0; i < evaluation.truth.size(); ++i) {
    add(evaluation.truth[i].name, evaluation.followed[i]);
  }
  add("all", evaluation.sum);
  return html + fmt::format("</table>\n<p>{}</p>\n", kTrueColumnsText);
}

/// Every person's row at a time.
std::vector<ViewedBody> BodiesAt(const PeopleEvaluation& evaluation, std::int64_t time_ns) {
  std::vector<ViewedBody> bodies;
  for (std::size_t i = 0; i < evaluation.people.size(); ++i) {
    const Result& result = evaluation.people[i].evaluation.result;
    const auto row = std::ranges::find(result.poses, time_ns, &PoseRow::timestamp_ns);
    if (row != result.poses.end()) bodies.push_back({*row, result.body.sizes, ColorOf(i)});
  }
  return bodies;
}

std::string PeopleViews(const PeopleEvaluation& evaluation, const TakeSamples& samples) {
  std::string html;
  for (const SampledMoment& moment : samples.moments) {
    const std::vector<ViewedBody> bodies = BodiesAt(evaluation, moment.timestamp_ns);
    std::string views;
    for (std::size_t c = 0; c < samples.cameras.size(); ++c) {
      const auto& view = moment.views[c];
      if (!view || view->image.empty() || bodies.empty()) continue;
      views += fmt::format("<div>{}{}</div>", CameraViewSvg(samples.cameras[c], *view, bodies),
                           EscapeHtml(samples.cameras[c].name));
    }
    if (views.empty()) continue;
    html += fmt::format("<h3>Frame {}</h3><div class=\"views\">{}</div>\n",
                        bodies.front().row.frame, views);
  }
  return "<h2>Camera views</h2>\n<p class=\"key\">" + TrimapKey() + "</p>\n" + html;
}

std::string PlotFigure(const PlotAxes& axes, std::span<const PlotSeries> series,
                       const std::string& caption) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", PlotSvg(axes, series),
                     caption);
}

/// Everyone's path from above.
std::string PathsFigure(const PeopleEvaluation& evaluation, const TakeSamples& samples) {
  std::vector<PlotSeries> series;
  PlotSeries& seats = series.emplace_back(PlotSeries{"camera", {}, 3, PlotMark::kRings});
  for (const auto& [name, p_WC] : CameraPlaces(samples)) {
    seats.points.push_back(Vector2(p_WC.head<2>() / 1000));
    seats.names.push_back(name);
  }
  for (std::size_t i = 0; i < evaluation.people.size(); ++i) {
    PlotSeries path{evaluation.people[i].name, {}, ColorOf(i)};
    for (const PoseRow& row : evaluation.people[i].evaluation.result.poses) {
      path.points.push_back(IsTracked(row) ? Vector2(row.paper.torso_mm.head<2>() / 1000)
                                           : Vector2(kPlotGap, kPlotGap));
    }
    series.push_back(std::move(path));
  }
  PlotAxes axes{"world x [m]", "world y [m]", 560, 520};
  axes.equal_scales = true;
  return "<div class=\"plan\">" +
         PlotFigure(axes, series, "<b>Paths of the torsos</b> from above, with the cameras.") +
         "</div>";
}

/// Everyone's error.
std::string ErrorsFigure(const PeopleEvaluation& evaluation) {
  if (evaluation.truth.empty()) return {};
  std::vector<PlotSeries> series;
  for (std::size_t i = 0; i < evaluation.people.size(); ++i) {
    PlotSeries curve{evaluation.people[i].name, {}, ColorOf(i)};
    for (const PersonMatch& match : evaluation.people[i].matches) {
      const auto& poses = evaluation.people[i].evaluation.result.poses;
      const auto frame = static_cast<double>(poses[static_cast<std::size_t>(match.pose)].frame);
      if (!curve.points.empty() && frame > curve.points.back().x() + 1.5) {
        curve.points.emplace_back(frame - 1, kPlotGap);
      }
      curve.points.emplace_back(frame, match.mean_mm);
    }
    series.push_back(std::move(curve));
  }
  PlotAxes axes{"frame number", "error [mm]", 900, 220};
  const auto [first, last] = PeopleFrameRange(evaluation);
  axes.x_range = Vector2(first, last);
  return PlotFigure(axes, series, "<b>Distance from the truth</b>, mean of 14 points.");
}

std::string PersonSections(const PeopleEvaluation& evaluation, const TakeSamples& samples) {
  std::string html;
  for (std::size_t i = 0; i < evaluation.people.size(); ++i) {
    const TrackedPerson& person = evaluation.people[i];
    if (person.evaluation.first_tracked_pose < 0) continue;
    html += fmt::format("<details><summary>{}{}</summary>{}</details>\n", Swatch(i),
                        EscapeHtml(person.name), TrackingSections(person.evaluation, samples));
  }
  return "<h2>Each person</h2>\n" + html;
}

std::vector<double> FramesOf(const PeopleEvaluation& evaluation, const TakeSamples& samples) {
  std::vector<double> frames;
  for (const SampledMoment& moment : samples.moments) {
    const std::vector<ViewedBody> bodies = BodiesAt(evaluation, moment.timestamp_ns);
    frames.push_back(bodies.empty() ? kPlotGap : static_cast<double>(bodies.front().row.frame));
  }
  return frames;
}

}  // namespace

std::vector<SampleRequest> ChooseReportMoments(const PeopleEvaluation& evaluation) {
  std::set<std::int64_t> tracked_ns;
  for (const TrackedPerson& person : evaluation.people) {
    for (const PoseRow& row : person.evaluation.result.poses) {
      if (IsTracked(row)) tracked_ns.insert(row.timestamp_ns);
    }
  }
  return ChooseReportMoments(std::vector<std::int64_t>(tracked_ns.begin(), tracked_ns.end()));
}

std::string PeopleReportHtml(const PeopleEvaluation& evaluation, const TakeSamples& samples,
                             const std::vector<CameraOverlap>& overlaps) {
  const std::vector<double> frames = FramesOf(evaluation, samples);
  const std::string under = CountedPeople(evaluation.people.size()) + " tracked, " +
                            Counted(samples.cameras.size(), "camera");
  return ReportPage(evaluation.take, under,
                    PeopleTiles(evaluation) + Timelines(evaluation) + TrackedRows(evaluation) +
                        TrueRows(evaluation) + PeopleViews(evaluation, samples) +
                        PathsFigure(evaluation, samples) + ErrorsFigure(evaluation) +
                        PersonSections(evaluation, samples) + OverlapSection(frames, overlaps));
}

}  // namespace mocap
