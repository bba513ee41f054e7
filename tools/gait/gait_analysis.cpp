#include "tools/gait/gait_analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "drivers/take/text_file.h"

namespace mocap {
namespace {

std::string Underscored(std::string_view name) {
  std::string text(name);
  std::ranges::replace(text, ' ', '_');
  return text;
}

// "step_length_mm"
std::string ColumnOf(const GaitFigure& figure) {
  std::string unit(figure.unit);
  if (unit == "%") unit = "percent";
  if (unit == "m/s") unit = "m_s";
  if (unit == "steps/min") unit = "steps_min";
  return Underscored(figure.name) + '_' + unit;
}

constexpr int kDecimals = 4;

Json NumberJson(double value) {
  return std::isnan(value) ? Json() : Rounded(value, kDecimals);
}

std::string_view NameOf(Side side) { return kSideNames[static_cast<std::size_t>(side)]; }
std::string_view NameOf(GaitEventKind kind) {
  return kGaitEventNames[static_cast<std::size_t>(kind)];
}

std::string EventsCsv(const GaitAnalysis& gait) {
  std::string text = "time_s,side,event\n";
  for (const GaitEvent& event : gait.events)
    text += fmt::format("{:.4f},{},{}\n", event.time_s, NameOf(event.side), NameOf(event.kind));
  return text;
}

std::string StridesCsv(const GaitAnalysis& gait) {
  std::string text = "side,begin_s,end_s";
  for (const GaitFigure& figure : kGaitFigures) text += ',' + ColumnOf(figure);
  text += '\n';
  for (const Stride& stride : gait.strides) {
    text += fmt::format("{},{:.4f},{:.4f}", NameOf(stride.side), stride.begin_s, stride.end_s);
    for (const GaitFigure& figure : kGaitFigures) text += fmt::format(",{:.4f}", figure.of(stride));
    text += '\n';
  }
  return text;
}

std::string FiguresCsv(const GaitAnalysis& gait) {
  std::string text = "figure,unit,left_mean,left_sd,right_mean,right_sd,symmetry_percent\n";
  const auto cells = [](const MeanAndSpread& side) {
    return side.count > 0 ? fmt::format("{:.4f},{:.4f}", side.mean, side.spread) : ",";
  };
  for (std::size_t i = 0; i < kGaitFigures.size(); ++i) {
    const double symmetry = gait.summary.symmetry_percent[i];
    text += fmt::format("{},{},{},{},{}\n", kGaitFigures[i].name, kGaitFigures[i].unit,
                        cells(gait.summary.figures[0][i]), cells(gait.summary.figures[1][i]),
                        std::isnan(symmetry) ? "" : fmt::format("{:.2f}", symmetry));
  }
  return text;
}

std::string CycleCsv(const GaitAnalysis& gait) {
  std::string text = "angle,side,strides,percent,mean_deg,sd_deg\n";
  for (const CycleCurve& curve : gait.curves)
    for (int percent = 0; percent < kCycleSamples; ++percent)
      text +=
          fmt::format("{},{},{},{},{:.3f},{:.3f}\n", curve.angle, NameOf(curve.side), curve.strides,
                      percent, curve.mean_deg[percent], curve.spread_deg[percent]);
  return text;
}

Json FiguresJson(const GaitSummary& summary) {
  Json json = Json::object();
  for (std::size_t i = 0; i < kGaitFigures.size(); ++i) {
    Json& figure = json[ColumnOf(kGaitFigures[i])];
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const MeanAndSpread& measured = summary.figures[static_cast<std::size_t>(side)][i];
      if (measured.count == 0) continue;
      figure[std::string(NameOf(side))] = {{"mean", NumberJson(measured.mean)},
                                           {"sd", NumberJson(measured.spread)},
                                           {"strides", measured.count}};
    }
    figure["symmetry_percent"] = NumberJson(summary.symmetry_percent[i]);
  }
  return json;
}

Json CurveJson(const CycleCurve& curve) {
  Json json{{"angle", curve.angle}, {"side", NameOf(curve.side)}, {"strides", curve.strides}};
  for (const double deg : curve.mean_deg) json["mean_deg"].push_back(NumberJson(deg));
  for (const double deg : curve.spread_deg) json["sd_deg"].push_back(NumberJson(deg));
  return json;
}

}  // namespace

GaitAnalysis AnalyseGait(const Result& result) {
  const auto has_feet = [](const PoseRow& row) {
    return row.has_pose &&
           row.further_W.col(static_cast<int>(Point::kToeL) - kPointCount).allFinite();
  };
  if (std::ranges::none_of(result.poses, has_feet))
    throw SetupError(
        "the result has no heels and toes; expected one of a body whose feet turn, such as full");
  GaitAnalysis gait;
  for (const GaitRun& run : GaitRunsOf(result)) {
    gait.tracked_s += run.back().time_s - run.front().time_s;
    const std::vector<GaitEvent> events = FindGaitEvents(run);
    const std::vector<Stride> strides = StridesOf(run, events);
    gait.events.insert(gait.events.end(), events.begin(), events.end());
    gait.strides.insert(gait.strides.end(), strides.begin(), strides.end());
  }
  gait.summary = Summarize(gait.strides);
  gait.curves = CurvesOf(AnglesOf(result), result.poses.front().timestamp_ns, gait.strides);
  return gait;
}

std::string GaitText(const GaitAnalysis& gait) {
  const auto strides = [&](Side side) {
    return std::ranges::count(gait.strides, side, &Stride::side);
  };
  if (gait.strides.empty())
    return fmt::format("no whole stride in {:.1f} s of tracking\n", gait.tracked_s);
  std::string text =
      fmt::format("strides: {} left, {} right\n\n{:<16}{:<11}{:>18}{:>18}{:>12}\n",
                  strides(Side::kLeft), strides(Side::kRight), "", "", "left", "right", "symmetry");
  const auto cell = [](const MeanAndSpread& side, int decimals) {
    return side.count > 0
               ? fmt::format("{:.{}f} ± {:.{}f}", side.mean, decimals, side.spread, decimals)
               : std::string("-");
  };
  for (std::size_t i = 0; i < kGaitFigures.size(); ++i) {
    const GaitFigure& figure = kGaitFigures[i];
    const int decimals = figure.unit == "s" || figure.unit == "m/s" ? 2
                         : figure.unit == "mm"                      ? 0
                                                                    : 1;
    const double symmetry = gait.summary.symmetry_percent[i];
    text += fmt::format("{:<16}{:<11}{:>18}{:>18}{:>12}\n", figure.name, figure.unit,
                        cell(gait.summary.figures[0][i], decimals),
                        cell(gait.summary.figures[1][i], decimals),
                        std::isnan(symmetry) ? "-" : fmt::format("{:.1f} %", symmetry));
  }
  return text;
}

Json GaitJson(const GaitAnalysis& gait) {
  Json json{{"tracked_s", NumberJson(gait.tracked_s)},
            {"events", Json::array()},
            {"strides", Json::array()},
            {"figures", FiguresJson(gait.summary)},
            {"cycle", Json::array()}};
  for (const GaitEvent& event : gait.events)
    json["events"].push_back({{"time_s", NumberJson(event.time_s)},
                              {"side", NameOf(event.side)},
                              {"event", NameOf(event.kind)}});
  for (const Stride& stride : gait.strides) {
    Json row{{"side", NameOf(stride.side)},
             {"begin_s", NumberJson(stride.begin_s)},
             {"end_s", NumberJson(stride.end_s)}};
    for (const GaitFigure& figure : kGaitFigures)
      row[ColumnOf(figure)] = NumberJson(figure.of(stride));
    json["strides"].push_back(std::move(row));
  }
  for (const CycleCurve& curve : gait.curves) json["cycle"].push_back(CurveJson(curve));
  return json;
}

void WriteGait(const std::filesystem::path& folder, const GaitAnalysis& gait) {
  MakeFolder(folder);
  ReplaceText(folder / "events.csv", EventsCsv(gait));
  ReplaceText(folder / "strides.csv", StridesCsv(gait));
  ReplaceText(folder / "figures.csv", FiguresCsv(gait));
  ReplaceText(folder / "cycle.csv", CycleCsv(gait));
}

}  // namespace mocap
