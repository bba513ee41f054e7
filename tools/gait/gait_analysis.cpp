#include "tools/gait/gait_analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "drivers/take/text_file.h"
#include "tools/results/export_axes.h"

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

Json NumberJson(double value) { return std::isnan(value) ? Json() : Rounded(value, kDecimals); }

constexpr std::string_view kEventsHead = "time_s,side,event\n", kStridesHead = "side,begin_s,end_s",
                           kFiguresHead = "figure,unit,left_mean,left_sd,right_mean,right_sd,",
                           kCycleHead = "angle,side,strides,percent,mean_deg,sd_deg\n";

std::string EventsCsv(const GaitAnalysis& gait) {
  std::string text(kEventsHead);
  for (const GaitEvent& event : gait.events)
    text += fmt::format("{:.4f},{},{}\n", event.time_s, NameOf(event.side), NameOf(event.kind));
  return text;
}

std::string StridesCsv(const GaitAnalysis& gait) {
  std::string text(kStridesHead);
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
  std::string text = std::string(kFiguresHead) + "symmetry_percent\n";
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
  std::string text(kCycleHead);
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

Json CheckJson(const EventCheck& check) {
  Json json = Json::object();
  for (std::size_t kind = 0; kind < check.size(); ++kind) {
    const EventAgreement& one = check[kind];
    Json& row = json[std::string(kGaitEventNames[kind])];
    row = {{"by_contact", one.by_contact},
           {"by_position", one.by_position},
           {"both", one.later_s.count}};
    if (one.later_s.count == 0) continue;
    row["position_later_s"] = NumberJson(one.later_s.mean);
    row["sd_s"] = NumberJson(one.later_s.spread);
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

GaitAnalysis AnalyseGait(const Result& result, const std::string& where) {
  if (std::ranges::any_of(result.poses, IsTracked) && std::ranges::none_of(result.poses, HasFeet))
    throw SetupError(where +
                     ": no frame has heels and toes; expected those of a body with feet, such as "
                     "full, tracked by a version that writes them");
  GaitAnalysis gait;
  std::vector<GaitEvent> by_position;
  const auto append = [](const auto& added, auto& list) {
    list.insert(list.end(), added.begin(), added.end());
  };
  for (const GaitRun& run : GaitRunsOf(result)) {
    gait.tracked_s += run.back().time_s - run.front().time_s;
    const std::vector<GaitEvent> events = FindGaitEvents(run);
    append(events, gait.events);
    append(StancePhasesOf(events), gait.stances);
    append(StridesOf(run, events), gait.strides);
    append(FindPositionEvents(run), by_position);
  }
  if (HasContacts(result)) gait.check = CompareEvents(gait.events, by_position);
  gait.summary = Summarize(gait.strides);
  if (!gait.strides.empty())
    gait.curves = CurvesOf(AnglesOf(result), result.poses.front().timestamp_ns, gait.strides);
  return gait;
}

Json GaitJson(const GaitAnalysis& gait) {
  Json json{{"tracked_s", NumberJson(gait.tracked_s)},
            {"events_by", gait.check ? "contact" : "position"},
            {"events", Json::array()},
            {"strides", Json::array()},
            {"figures", FiguresJson(gait.summary)},
            {"cycle", Json::array()}};
  if (gait.check) json["event_check"] = CheckJson(*gait.check);
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

void RequireRoomForGait(const std::filesystem::path& folder) {
  MakeFolder(folder);
  const auto require = [&](const char* name, std::string_view head) {
    RequireWritable(folder / name);
    RequireOwn(folder / name, std::span(&head, 1), "a table of mocap gait");
  };
  require("events.csv", kEventsHead);
  require("strides.csv", kStridesHead);
  require("figures.csv", kFiguresHead);
  require("cycle.csv", kCycleHead);
}

void WriteGait(const std::filesystem::path& folder, const GaitAnalysis& gait) {
  ReplaceText(folder / "events.csv", EventsCsv(gait));
  ReplaceText(folder / "strides.csv", StridesCsv(gait));
  ReplaceText(folder / "figures.csv", FiguresCsv(gait));
  ReplaceText(folder / "cycle.csv", CycleCsv(gait));
}

}  // namespace mocap
