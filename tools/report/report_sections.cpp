#include "tools/report/report_sections.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/joint_names.h"
#include "core/degrees.h"
#include "tools/report/report.h"
#include "tools/report/report_figures.h"
#include "tools/report/report_style.h"
#include "tools/report/svg_plot.h"

namespace mocap {
namespace {

/// A table with a bar beside each value.
struct BarRow {
  std::string name;
  double value;
};
std::string BarTable(const std::string& what, const std::string& unit,
                     const std::vector<BarRow>& rows) {
  double largest = 1e-9;
  for (const BarRow& row : rows) largest = std::max(largest, row.value);
  std::string html = fmt::format("<table><tr><th>{}</th><th class=\"n\">{}</th><th></th></tr>",
                                 EscapeHtml(what), unit);
  for (const BarRow& row : rows) {
    html += fmt::format(
        "<tr><td>{}</td><td class=\"n\">{:.2f}</td><td class=\"bar\"><i "
        "style=\"width:{:.0f}%\"></i></td></tr>",
        EscapeHtml(row.name), row.value, 100 * row.value / largest);
  }
  return html + "</table>";
}

std::string AccuracyTables(const Evaluation& evaluation) {
  const Accuracy& accuracy = *evaluation.accuracy;
  std::vector<BarRow> points, angles;
  for (int i = 0; i < kScoredPointCount; ++i) {
    points.push_back(
        {std::string(kPointNames[static_cast<int>(kScoredPoints[i])]), accuracy.point_mm[i]});
  }
  for (int i = 0; i < kScoredAngleCount; ++i) {
    angles.push_back({std::string(kScoredAngleNames[i]), accuracy.angle_rad[i] * kDegreesPerRad});
  }
  std::string lengths =
      "<table><tr><th>length</th><th class=\"n\">acquired mm</th><th class=\"n\">true mm</th><th "
      "class=\"n\">error mm</th></tr>";
  for (const LengthPair& pair : evaluation.lengths) {
    lengths += fmt::format(
        "<tr><td>{}</td><td class=\"n\">{:.1f}</td><td class=\"n\">{:.1f}</td><td "
        "class=\"n\">{:+.1f}</td></tr>",
        pair.name, pair.acquired_mm, pair.true_mm, pair.acquired_mm - pair.true_mm);
  }
  return "<div class=\"two\"><div>" + BarTable("mean error of point", "mm", points) +
         "</div><div>" + BarTable("mean error of angle", "°", angles) + "<h3>Lengths</h3>" +
         lengths + "</table></div></div>\n";
}

std::string PrecisionSection(const Evaluation& evaluation) {
  std::string html = "<h2>Precision</h2>\n";
  if (!evaluation.precision) return html + "<p>No run of 15 tracked frames.</p>\n";
  const Precision& precision = *evaluation.precision;
  std::vector<BarRow> angles, points;
  for (int i = 0; i < kPaperAngleCount; ++i) {
    angles.push_back({fmt::format("θ{} {}", i + 1, kPaperJointNames[i]),
                      precision.angle_rad[i] * kDegreesPerRad});
  }
  for (int i = 0; i < kPointCount; ++i) {
    points.push_back({std::string(kPointNames[i]), precision.point_mm[i]});
  }
  html += fmt::format(
      "<p>Mean absolute difference between the output and a smooth curve through it "
      "(Savitzky–Golay, order 3, 15 frames), over {} frames: what the paper gives in place of a "
      "comparison with the truth. Mean of the angles {:.2f}°; {:.2f}° without θ7 and θ8, which are "
      "undefined while an arm is straight.</p>\n",
      precision.frames, precision.mean_angle_rad * kDegreesPerRad,
      precision.mean_angle_without_twist_rad * kDegreesPerRad);
  return html + "<div class=\"two\"><div>" + BarTable("angle", "°", angles) + "</div><div>" +
         BarTable("point", "mm", points) + "</div></div>\n";
}

/// What the terminal tells.
std::string CertaintyHtml(const Evaluation& evaluation) {
  if (!evaluation.certainty) return {};
  return "<pre>" + CertaintyText(*evaluation.certainty) + ProbabilityTextOf(evaluation.certainty) +
         "</pre>\n";
}

}  // namespace

std::vector<std::pair<std::string, Vector3>> CameraPlaces(const TakeSamples& samples) {
  std::vector<std::pair<std::string, Vector3>> places;
  for (const CameraCalibration& camera : samples.cameras) {
    places.emplace_back(camera.name, camera.X_CW.Inverse().p);
  }
  return places;
}

std::string TrackingSections(const Evaluation& evaluation, const TakeSamples& samples) {
  std::string html = "<h2>The paper’s figures</h2>\n" + PartSizesFigure(evaluation) +
                     "<div class=\"plan\">" + TorsoPathFigure(evaluation, CameraPlaces(samples)) +
                     "</div>" + HipKneeFigure(evaluation);
  if (evaluation.accuracy && !evaluation.accuracy->frames.empty()) {
    html += "<h2>Accuracy</h2>\n" + ErrorFigure(evaluation) + AccuracyTables(evaluation) +
            ScoredAnglesFigure(evaluation);
  }
  return html + PrecisionSection(evaluation) + "<h2>The tracker’s own view</h2>\n" +
         CertaintyHtml(evaluation) + ResidualFigure(evaluation);
}

std::string Tile(const std::string& what, const std::string& value, const std::string& unit,
                 const std::string& under) {
  return fmt::format(
      "<div class=\"tile\"><span>{}</span><b>{}<small>{}</small></b><span>{}</span></div>", what,
      value, unit, under);
}

std::string OverlapSection(std::span<const double> frames,
                           const std::vector<CameraOverlap>& overlaps) {
  std::string html = fmt::format(
      "<h2>Voxels and silhouettes</h2>\n{}<table><tr><th>camera</th><th class=\"n\">frames</th><th "
      "class=\"n\">mean IoU %</th><th class=\"n\">lowest %</th><th class=\"n\">unknown "
      "%</th></tr>",
      OverlapFigure(overlaps, frames));
  for (const CameraOverlap& overlap : overlaps) {
    html += fmt::format(
        "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{:.1f}</td><td "
        "class=\"n\">{:.1f}</td><td class=\"n\">{}</td></tr>",
        EscapeHtml(overlap.camera), overlap.frames(), 100 * overlap.mean(), 100 * overlap.lowest(),
        overlap.unknown_share ? fmt::format("{:.0f}", 100 * *overlap.unknown_share) : "–");
  }
  return html +
         fmt::format(
             "</table><p>Unknown: pixels that show people, but cannot be told from the empty "
             "studio. Segmented and carved anew for this report with voxels of "
             "{:.0f} mm.</p>\n",
             kReportVoxelMm);
}

std::string ReportPage(const std::string& title, const std::string& under,
                       const std::string& body) {
  return fmt::format(
      "{0}\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\"><title>{1} – motion capture "
      "report</title><style>{2}</style></head><body><main>\n<h1>{1}</h1><p class=\"under\">{3}</p>"
      "\n{4}</main></body></html>\n",
      kReportBeginnings[0], EscapeHtml(title), kReportStyle, under, body);
}

}  // namespace mocap
