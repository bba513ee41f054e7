#include "tools/comparison/comparison_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drivers/printable_text.h"
#include "tools/comparison/comparison_text.h"
#include "tools/report/report_page.h"

namespace mocap {
namespace {

/// Of a curve, and of a plot of dots: more do not show.
constexpr std::size_t kMostSamples = 600, kMostDots = 300;
constexpr int kOwnColour = 0, kOtherColour = 1, kLimitColour = 2;

/// Every k-th value, so that at most so many are left.
std::vector<double> Thinned(const std::vector<double>& values, std::size_t most) {
  const std::size_t step = std::max<std::size_t>(1, (values.size() + most - 1) / most);
  std::vector<double> thin;
  for (std::size_t i = 0; i < values.size(); i += step) thin.push_back(values[i]);
  return thin;
}

Json NumbersOf(const std::vector<double>& values) {
  Json numbers = Json::array();
  for (const double value : values) numbers.push_back(NumberOrNull(value));
  return numbers;
}

Json CurvesPlot(const std::vector<double>& time_s, const std::vector<double>& own,
                const std::vector<double>& other, const std::string& label) {
  return {{"x", {{"label", "time [s]"}, {"values", NumbersOf(Thinned(time_s, kMostSamples))}}},
          {"y", {{"label", label}}},
          {"height", 130},
          {"series",
           {Series("mocapd", kOwnColour, "line", NumbersOf(Thinned(own, kMostSamples))),
            Series("other", kOtherColour, "line", NumbersOf(Thinned(other, kMostSamples)))}}};
}

Json LevelLine(const std::string& label, double level, const Json& ends, const char* mark) {
  return Series(label, kLimitColour, mark, Json::array({NumberOrNull(level), NumberOrNull(level)}),
                {{"x", ends}});
}

/// Differences over means (Bland and Altman 1986). @param label  with unit.
Json BlandAltmanPlot(const std::vector<double>& own, const std::vector<double>& other,
                     const std::string& label) {
  std::vector<double> mean, apart;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (!std::isfinite(own[i] - other[i])) continue;
    mean.push_back((own[i] + other[i]) / 2);
    apart.push_back(own[i] - other[i]);
  }
  const Agreement agreement = AgreementOf(apart);
  Json ends = Json::array();
  if (!mean.empty()) {
    const auto [low, high] = std::ranges::minmax(mean);
    ends = {NumberOrNull(low), NumberOrNull(high)};
  }
  return {{"x", {{"label", fmt::format("mean of both, {}", label)}}},
          {"y", {{"label", "difference" + label.substr(label.rfind(' '))}}},
          {"height", 130},
          {"series",
           {Series("", kOwnColour, "dots", NumbersOf(Thinned(apart, kMostDots)),
                   {{"x", NumbersOf(Thinned(mean, kMostDots))}}),
            LevelLine("bias", agreement.bias, ends, "line"),
            LevelLine("limits of agreement", agreement.lower, ends, "dashed"),
            LevelLine("", agreement.upper, ends, "dashed")}}};
}

Json AngleFigure(const Comparison& comparison, const AngleComparison& angle) {
  const Agreement& a = angle.agreement;
  const std::string label = angle.angle + " [°]";
  return Figure(
      angle.angle,
      fmt::format("bias {:+.2f}°, limits of agreement {:+.2f}° to {:+.2f}°, RMSD {:.2f}°.", a.bias,
                  a.lower, a.upper, a.rmsd),
      Json::array({CurvesPlot(comparison.time_s, angle.own_deg, angle.other_deg, label),
                   BlandAltmanPlot(angle.own_deg, angle.other_deg, label)}),
      2);
}

Json PointDetails(const Comparison& comparison, const PointComparison& point) {
  Json plots = Json::array();
  for (int axis = 0; axis < 3; ++axis) {
    const std::string label = fmt::format("{} [mm]", "xyz"[axis]);
    const std::vector<double> own = AxisOf(point.own_W, axis), other = AxisOf(point.other_W, axis);
    plots.push_back(CurvesPlot(comparison.time_s, own, other, label));
    plots.push_back(BlandAltmanPlot(own, other, label));
  }
  return Json::array({Figure(
      "",
      fmt::format("{} and {}, along the axes of the room. RMSD {:.1f} mm, without bias {:.1f} mm.",
                  point.point, OthersOf(point), point.distance.rmsd, point.rmsd_without_bias),
      plots, 2)});
}

/// All points together, along the axes of the room.
Json AllPointsFigure(const Comparison& comparison) {
  Json plots = Json::array();
  for (int axis = 0; axis < 3; ++axis) {
    const std::string label = fmt::format("{} [mm]", "xyz"[axis]);
    std::vector<double> own, other;
    for (const PointComparison& point : comparison.points) {
      for (const double value : AxisOf(point.own_W, axis)) own.push_back(value);
      for (const double value : AxisOf(point.other_W, axis)) other.push_back(value);
    }
    plots.push_back(BlandAltmanPlot(own, other, label));
  }
  return Figure("All points", "along x, y and z of the room.", plots, 2);
}

/// "LFHD + 3 more"
std::string FewOthersOf(const PointComparison& point) {
  if (point.others.size() <= 2) return OthersOf(point);
  return fmt::format("{} + {} more", Printable(point.others[0]), point.others.size() - 1);
}

Json Folded(const std::string& name, int figure, Json sections) {
  return {
      {"type", "details"}, {"name", name}, {"figure", figure}, {"sections", std::move(sections)}};
}

Json PointFiguresTable(const Comparison& comparison) {
  Json rows = Json::array();
  for (const PointComparison& point : comparison.points) {
    Json row = {point.point,
                FewOthersOf(point),
                point.distance.count,
                NumberOrNull(point.distance.bias),
                NumberOrNull(point.distance.rmsd),
                NumberOrNull(point.rmsd_without_bias)};
    for (const Agreement& axis : point.axes) row.push_back(NumberOrNull(axis.bias));
    for (const Agreement& axis : point.axes) row.push_back(NumberOrNull(1.96 * axis.deviation));
    row.push_back(NumberOrNull(point.speed_correlation));
    rows.push_back(std::move(row));
  }
  return Table({{"point"},
                {"other"},
                {"frames", 0},
                {"mean mm", 1},
                {"RMSD mm", 1},
                {"without bias", 1},
                {"bias ahead", 1, false, true},
                {"left", 1, false, true},
                {"up", 1, false, true},
                {"limits ± ahead", 1},
                {"left", 1},
                {"up", 1},
                {"r", 3}},
               rows);
}

Json AngleFiguresTable(const Comparison& comparison) {
  Json rows = Json::array();
  for (const AngleComparison& angle : comparison.angles) {
    const Agreement& a = angle.agreement;
    rows.push_back({angle.angle, a.count, NumberOrNull(a.bias), NumberOrNull(a.lower),
                    NumberOrNull(a.upper), NumberOrNull(a.rmsd), NumberOrNull(a.rmsd_without_bias),
                    NumberOrNull(angle.correlation), NumberOrNull(angle.multiple_correlation)});
  }
  return Table({{"angle"},
                {"frames", 0},
                {"bias °", 2, false, true},
                {"lower limit", 2, false, true},
                {"upper limit", 2, false, true},
                {"RMSD °", 2},
                {"without bias", 2},
                {"r", 3},
                {"CMC", 3}},
               rows);
}

Json ComparisonTiles(const Comparison& comparison) {
  return Tiles(Json::array(
      {Tile("Points", NumberOrNull(comparison.points_rmsd_mm), 1, "mm",
            fmt::format("RMSD of {}", Counted(comparison.points.size(), "point"))),
       Tile("Points without bias", NumberOrNull(comparison.points_rmsd_without_bias_mm), 1, "mm",
            "RMSD, each point’s mean difference removed"),
       Tile("Angles", NumberOrNull(comparison.angles_rmsd_deg), 2, "°",
            fmt::format("RMSD of {}", Counted(comparison.angles.size(), "angle"))),
       Tile("Angles without bias", NumberOrNull(comparison.angles_rmsd_without_bias_deg), 2, "°",
            "RMSD, each angle’s mean difference removed"),
       Tile("Offset", NumberOrNull(comparison.alignment.offset_s), 3, "s",
            fmt::format("added to the other’s time; {} in both",
                        Counted(comparison.time_s.size(), "frame")))}));
}

void AddPointSections(const Comparison& comparison, Json& sections) {
  if (comparison.points.empty()) return;
  sections.push_back(Heading("Points"));
  sections.push_back(Paragraph(
      "Differences are mocapd less the other, after the rigid transform. Bias and limits of "
      "agreement (1.96 standard deviations to both sides of the bias) are along the axes of the "
      "body segment: ahead, left and up of a person who stands. r is the correlation of speeds."));
  sections.push_back(PointFiguresTable(comparison));
  sections.push_back(AllPointsFigure(comparison));
  for (const PointComparison& point : comparison.points)
    sections.push_back(
        Folded(point.point + " – " + OthersOf(point), kOwnColour, PointDetails(comparison, point)));
}

void AddAngleSections(const Comparison& comparison, Json& sections) {
  sections.push_back(Heading("Angles"));
  if (comparison.angles.empty()) {
    sections.push_back(Paragraph("The recordings have no angle in common."));
    return;
  }
  if (comparison.angles_by_points) {
    sections.push_back(
        Paragraph("The other recording has no angles. A bend is the angle between two lines "
                  "through three points, measured in both recordings alike; straight is 0."));
  }
  sections.push_back(AngleFiguresTable(comparison));
  for (const AngleComparison& angle : comparison.angles)
    sections.push_back(AngleFigure(comparison, angle));
}

}  // namespace

std::string ComparisonReportHtml(const std::string& title, const Comparison& comparison) {
  Json sections = Json::array({ComparisonTiles(comparison)});
  for (const std::string& remark : comparison.remarks)
    sections.push_back(Paragraph(Printable(remark), "warn"));
  AddPointSections(comparison, sections);
  AddAngleSections(comparison, sections);
  return ReportHtml(title,
                    fmt::format("comparison with {}, paired by {}", comparison.format,
                                NameOf(comparison.alignment.by)),
                    sections);
}

}  // namespace mocap
