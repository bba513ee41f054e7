#include "tools/gait/gait_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "drivers/printable_text.h"
#include "tools/gait/gait_text.h"
#include "tools/report/report_figures.h"
#include "tools/report/report_page.h"

namespace mocap {
namespace {

int FigureOfSide(Side side) { return side == Side::kLeft ? kLeftFigure : kRightFigure; }

/// Places of the sides on the timeline: the left above.
int LaneOf(Side side) { return side == Side::kLeft ? 1 : 0; }

Json FiguresTableOf(const GaitSummary& summary) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < kGaitFigures.size(); ++i) {
    const GaitFigure& figure = kGaitFigures[i];
    rows.push_back({std::string(figure.name), std::string(figure.unit),
                    MeasuredText(figure, summary.figures[0][i]),
                    MeasuredText(figure, summary.figures[1][i]),
                    SymmetryText(summary.symmetry_percent[i])});
  }
  return Table({{"figure"}, {"unit"}, {"left"}, {"right"}, {"symmetry index"}}, rows);
}

/// A line for each stance of a side.
Json StancesOf(const GaitAnalysis& gait, Side side) {
  Json x = Json::array(), y = Json::array();
  for (const StancePhase& stance : gait.stances) {
    if (stance.side != side) continue;
    for (const double time_s : {stance.begin_s, stance.end_s}) {
      x.push_back(NumberOrNull(time_s));
      y.push_back(LaneOf(side));
    }
    x.push_back(Json());
    y.push_back(Json());
  }
  return Series(side == Side::kLeft ? "on the floor" : "", FigureOfSide(side), "line", y,
                {{"x", x}});
}

Json EventsSeries(const GaitAnalysis& gait, Side side, GaitEventKind kind) {
  Json x = Json::array(), y = Json::array();
  for (const GaitEvent& event : gait.events) {
    if (event.side != side || event.kind != kind) continue;
    x.push_back(NumberOrNull(event.time_s));
    y.push_back(LaneOf(side));
  }
  const bool strikes = kind == GaitEventKind::kFootStrike;
  const std::string label = strikes ? "foot strike" : "foot off";
  return Series(side == Side::kLeft ? label : "", FigureOfSide(side), strikes ? "dots" : "rings", y,
                {{"x", x}});
}

Json EventsFigure(const GaitAnalysis& gait) {
  Json series = Json::array();
  for (const Side side : {Side::kLeft, Side::kRight}) {
    series.push_back(StancesOf(gait, side));
    series.push_back(EventsSeries(gait, side, GaitEventKind::kFootStrike));
    series.push_back(EventsSeries(gait, side, GaitEventKind::kFootOff));
  }
  return Figure(
      "Events", EventsText(gait) + ".",
      Json::array({{{"x", {{"label", "time since the first frame [s]"}}},
                    {"y", {{"label", ""}, {"names", {"right", "left"}}, {"range", {-0.6, 1.6}}}},
                    {"height", 70},
                    {"series", series}}}));
}

/// Mean with one standard deviation to both sides, as an outline.
Json BandOf(const CycleCurve& curve) {
  Json x = Json::array(), y = Json::array();
  for (int percent = 0; percent < kCycleSamples; ++percent) {
    x.push_back(percent);
    y.push_back(NumberOrNull(curve.mean_deg[percent] + curve.spread_deg[percent]));
  }
  for (int percent = kCycleSamples; percent-- > 0;) {
    x.push_back(percent);
    y.push_back(NumberOrNull(curve.mean_deg[percent] - curve.spread_deg[percent]));
  }
  return Series("", FigureOfSide(curve.side), "area", y, {{"x", x}});
}

Json MeanCurve(const CycleCurve& curve) {
  Json y = Json::array();
  for (const double deg : curve.mean_deg) y.push_back(NumberOrNull(deg));
  return Series(std::string(NameOf(curve.side)), FigureOfSide(curve.side), "line", y);
}

/// The angle without its side.
std::string AngleOf(const CycleCurve& curve) {
  const std::string& name = curve.angle;
  return name.ends_with("_l") || name.ends_with("_r") ? name.substr(0, name.size() - 2) : name;
}

Json CurvesFigure(const GaitAnalysis& gait) {
  std::vector<std::string> angles;
  std::map<std::string, Json> series;
  for (const CycleCurve& curve : gait.curves) {
    const std::string angle = AngleOf(curve);
    if (!series.contains(angle)) angles.push_back(angle);
    series[angle].push_back(MeanCurve(curve));
  }
  for (const CycleCurve& curve : gait.curves) series[AngleOf(curve)].push_back(BandOf(curve));
  Json plots = Json::array();
  for (const std::string& angle : angles)
    plots.push_back({{"x", {{"label", "gait cycle [%]"}, {"first", 0}}},
                     {"y", {{"label", angle + " [°]"}}},
                     {"height", 130},
                     {"series", series[angle]}});
  return Figure("Angles over the gait cycle",
                "from a foot’s strike to its next. Lines: mean of the strides of that side; bands: "
                "one standard deviation. Names and signs as in the exported .mot.",
                plots, 2);
}

Json GaitSections(const GaitAnalysis& gait) {
  if (gait.strides.empty())
    return {Paragraph(fmt::format("No whole stride in {:.1f} s of tracking.", gait.tracked_s))};
  return {FiguresTableOf(gait.summary), EventsFigure(gait), CurvesFigure(gait)};
}

}  // namespace

std::string GaitReportHtml(const std::string& title, const PeopleGaits& people) {
  Json sections = Json::array();
  std::size_t strides = 0;
  double tracked_s = 0;
  for (const auto& [name, gait] : people) {
    if (!name.empty()) sections.push_back(Heading(Printable(name)));
    Append(GaitSections(gait), sections);
    strides += gait.strides.size();
    tracked_s += gait.tracked_s;
  }
  return ReportHtml(
      title, fmt::format("gait: {} in {:.1f} s of tracking", Counted(strides, "stride"), tracked_s),
      sections);
}

}  // namespace mocap
