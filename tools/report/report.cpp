#include "tools/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "drivers/printable_text.h"
#include "tools/report/report_figures.h"
#include "tools/report/report_style.h"
#include "tools/report/report_views.h"
#include "tools/report/svg_plot.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

constexpr int kCarvedMoments = 20;
constexpr int kShownMoments = 4;

/// The result's row at a sampled moment.
const PoseRow& RowAt(const Evaluation& evaluation, const SampledMoment& moment) {
  return *std::ranges::find(evaluation.result.poses, moment.timestamp_ns, &PoseRow::timestamp_ns);
}

std::string Tile(const std::string& what, const std::string& value, const std::string& unit,
                 const std::string& under) {
  return fmt::format(
      "<div class=\"tile\"><span>{}</span><b>{}<small>{}</small></b><span>{}</span></div>", what,
      value, unit, under);
}

std::string AccuracyTiles(const Evaluation& evaluation) {
  const Accuracy& accuracy = *evaluation.accuracy;
  const DistanceSummary& d = accuracy.distance_mm;
  return Tile("Error of 14 points", fmt::format("{:.1f}", d.mean), " mm",
              fmt::format("median {:.1f}, 95 % below {:.1f}, worst {:.0f}", d.median, d.p95,
                          d.worst)) +
         Tile("Spread", fmt::format("{:.1f}", accuracy.spread_mm), " mm",
              "without each point’s own offset") +
         Tile("Error of 8 angles",
              fmt::format("{:.2f}", accuracy.mean_angle_rad * kDegreesPerRadian), "°",
              "mean absolute") +
         Tile("Head found", fmt::format("{:.1f}", 100 * accuracy.head_found_share), " %",
              fmt::format("within {:.0f} mm", kHeadFoundMm));
}

std::string Tiles(const Evaluation& evaluation, const std::vector<CameraOverlap>& overlaps) {
  const BodyRecord& body = evaluation.result.body;
  std::string tiles = "<div class=\"tiles\">";
  if (evaluation.accuracy && !evaluation.accuracy->frames.empty()) {
    tiles += AccuracyTiles(evaluation);
  }
  tiles += Tile("Tracked", fmt::format("{:.1f}", 100 * evaluation.tracked_share), " %",
                evaluation.first_tracked_pose < 0
                    ? "never"
                    : fmt::format("from frame {} on",
                                  evaluation.result.poses[evaluation.first_tracked_pose].frame));
  if (const auto& precision = evaluation.precision) {
    tiles += Tile("Precision of angles",
                  fmt::format("{:.2f}", precision->mean_angle_rad * kDegreesPerRadian), "°",
                  "against the smoothed curve") +
             Tile("Precision of points", fmt::format("{:.1f}", precision->mean_point_mm), " mm",
                  "against the smoothed path");
  }
  if (!overlaps.empty()) {
    double mean = 0;
    for (const CameraOverlap& overlap : overlaps) {
      mean += overlap.mean() / static_cast<double>(overlaps.size());
    }
    tiles += Tile("Hull overlap", fmt::format("{:.1f}", 100 * mean), " %",
                  "voxels against silhouettes, IoU");
  }
  if (evaluation.first_tracked_pose >= 0) {
    tiles += Tile("Stature", fmt::format("{:.0f}", body.stature_mm), " mm",
                  evaluation.truth ? fmt::format("truly {:.0f} mm", evaluation.truth->stature_mm)
                                   : "as acquired");
  }
  return tiles + "</div>\n";
}

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
    angles.push_back(
        {std::string(kScoredAngleNames[i]), accuracy.angle_rad[i] * kDegreesPerRadian});
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
    angles.push_back({fmt::format("θ{} {}", i + 1, kPaperAngleLabels[i]),
                      precision.angle_rad[i] * kDegreesPerRadian});
  }
  for (int i = 0; i < kPointCount; ++i) {
    points.push_back({std::string(kPointNames[i]), precision.point_mm[i]});
  }
  html += fmt::format(
      "<p>Mean absolute difference between the output and a smooth curve through it "
      "(Savitzky–Golay, order 3, 15 frames), over {} frames: what the paper gives in place of a "
      "comparison with the truth. Mean of the angles {:.2f}°; {:.2f}° without θ7 and θ8, which are "
      "undefined while an arm is straight.</p>\n",
      precision.frames, precision.mean_angle_rad * kDegreesPerRadian,
      precision.mean_angle_without_twist_rad * kDegreesPerRadian);
  return html + "<div class=\"two\"><div>" + BarTable("angle", "°", angles) + "</div><div>" +
         BarTable("point", "mm", points) + "</div></div>\n";
}

std::string ViewsSection(const Evaluation& evaluation, const TakeSamples& samples,
                         const std::vector<CameraOverlap>& overlaps) {
  std::string html;
  for (std::size_t m = 0; m < samples.moments.size(); ++m) {
    const SampledMoment& moment = samples.moments[m];
    const PoseRow& row = RowAt(evaluation, moment);
    std::string views;
    for (std::size_t c = 0; c < samples.cameras.size(); ++c) {
      const auto& view = moment.views[c];
      if (!view || view->image.empty()) continue;
      views +=
          fmt::format("<div>{}{} · IoU {:.0f} %</div>",
                      CameraViewSvg(samples.cameras[c], *view, row, evaluation.result.body.sizes),
                      EscapeHtml(samples.cameras[c].name), 100 * overlaps[c].iou[m]);
    }
    if (views.empty()) continue;
    const double seconds =
        1e-9 * static_cast<double>(row.timestamp_ns - evaluation.result.poses[0].timestamp_ns);
    html += fmt::format("<h3>Frame {}, {:.2f} s, {}</h3><div class=\"views\">{}</div>\n", row.frame,
                        seconds, kCaptureStateNames[static_cast<std::size_t>(row.state)], views);
  }
  if (html.empty()) html = "<p>No frame of the take has the time of a frame of the result.</p>\n";
  return "<h2>Camera views</h2>\n<p class=\"key\"><span><i class=\"silhouette\"></i>silhouette"
         "</span><span><i class=\"left\"></i>the person’s left</span><span><i class=\"right\"></i>"
         "right</span></p>\n" +
         html;
}

std::string OverlapSection(const Evaluation& evaluation, const TakeSamples& samples,
                           const std::vector<CameraOverlap>& overlaps) {
  std::vector<double> frames;
  for (const SampledMoment& moment : samples.moments) {
    frames.push_back(static_cast<double>(RowAt(evaluation, moment).frame));
  }
  std::string html = fmt::format(
      "<h2>Voxels and silhouettes</h2>\n{}<table><tr><th>camera</th><th class=\"n\">frames</th><th "
      "class=\"n\">mean IoU %</th><th class=\"n\">lowest %</th></tr>",
      OverlapFigure(overlaps, frames));
  for (const CameraOverlap& overlap : overlaps) {
    html += fmt::format(
        "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{:.1f}</td><td "
        "class=\"n\">{:.1f}</td></tr>",
        EscapeHtml(overlap.camera), overlap.frames(), 100 * overlap.mean(), 100 * overlap.lowest());
  }
  return html + fmt::format(
                    "</table><p>Segmented and carved anew for this report with voxels of "
                    "{:.0f} mm.</p>\n",
                    kReportVoxelMm);
}

std::vector<std::pair<std::string, Vector3>> CameraPlaces(const TakeSamples& samples) {
  std::vector<std::pair<std::string, Vector3>> places;
  for (const CameraCalibration& camera : samples.cameras) {
    places.emplace_back(camera.name, camera.X_CW.Inverse().p);
  }
  return places;
}

/// Everything that only a tracked person makes possible.
std::string TrackingSections(const Evaluation& evaluation, const TakeSamples& samples) {
  std::string html = "<h2>The paper’s figures</h2>\n" + PartSizesFigure(evaluation) +
                     "<div class=\"plan\">" + TorsoPathFigure(evaluation, CameraPlaces(samples)) +
                     "</div>" + HipKneeFigure(evaluation);
  if (evaluation.accuracy && !evaluation.accuracy->frames.empty()) {
    html += "<h2>Accuracy</h2>\n" + ErrorFigure(evaluation) + AccuracyTables(evaluation) +
            ScoredAnglesFigure(evaluation);
  }
  return html + PrecisionSection(evaluation) + "<h2>The tracker’s own view</h2>\n" +
         ResidualFigure(evaluation);
}

}  // namespace

std::vector<SampleRequest> ChooseReportMoments(const Evaluation& evaluation) {
  std::vector<const PoseRow*> rows;
  for (const PoseRow& row : evaluation.result.poses) {
    if (evaluation.first_tracked_pose < 0 || IsTracked(row)) rows.push_back(&row);
  }
  const std::size_t count = std::min<std::size_t>(kCarvedMoments, rows.size());
  std::vector<SampleRequest> requests;
  for (std::size_t i = 0; i < count; ++i) {
    requests.push_back({rows[(2 * i + 1) * rows.size() / (2 * count)]->timestamp_ns, false});
  }
  const std::size_t shown = std::min<std::size_t>(kShownMoments, count);
  for (std::size_t i = 0; i < shown; ++i) {
    requests[(2 * i + 1) * count / (2 * shown)].keep_images = true;
  }
  return requests;
}

std::vector<CameraOverlap> MeasureOverlaps(const TakeSamples& samples) {
  std::vector<CameraOverlap> overlaps;
  for (std::size_t c = 0; c < samples.cameras.size(); ++c) {
    CameraOverlap& overlap = overlaps.emplace_back(CameraOverlap{samples.cameras[c].name, {}});
    for (const SampledMoment& moment : samples.moments) {
      const auto& view = moment.views[c];
      overlap.iou.push_back(
          view ? OverlapOf(ProjectVoxels(moment.voxels, samples.cameras[c], view->X_CW),
                           view->silhouette)
               : std::numeric_limits<double>::quiet_NaN());
    }
  }
  // Cameras that saw nothing in the whole take come last.
  while (!overlaps.empty() && overlaps.back().frames() == 0) overlaps.pop_back();
  return overlaps;
}

std::string ReportHtml(const Evaluation& evaluation, const TakeSamples& samples,
                       const std::vector<CameraOverlap>& overlaps) {
  const std::vector<PoseRow>& poses = evaluation.result.poses;
  const double seconds =
      poses.empty()
          ? 0
          : 1e-9 * static_cast<double>(poses.back().timestamp_ns - poses.front().timestamp_ns);
  std::string html = fmt::format(
      "{7}\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\"><title>{0} – motion capture "
      "report</title><style>{1}</style></head><body><main>\n<h1>{0}</h1><p class=\"under\">{2} "
      "in {3:.1f} s from {4} · body “{5}”{6}</p>\n",
      EscapeHtml(evaluation.take), kReportStyle, Counted(poses.size(), "frame"), seconds,
      Counted(samples.cameras.size(), "camera"), EscapeHtml(evaluation.result.body.model),
      evaluation.truth ? "" : " · no truth: accuracy cannot be told, precision can",
      kReportBeginnings[0]);
  html += Tiles(evaluation, overlaps) + StateTimeline(evaluation) +
          ViewsSection(evaluation, samples, overlaps);
  if (evaluation.first_tracked_pose >= 0) {
    html += TrackingSections(evaluation, samples);
  } else {
    html += "<p>The person was never tracked, so there is nothing to say about poses.</p>\n";
  }
  return html + OverlapSection(evaluation, samples, overlaps) + "</main></body></html>\n";
}

}  // namespace mocap
