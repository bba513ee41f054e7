#include "tools/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/degrees.h"
#include "core/reconstruction/carving/unknown_share.h"
#include "drivers/printable_text.h"
#include "tools/report/report_figures.h"
#include "tools/report/report_sections.h"
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

std::string AccuracyTiles(const Evaluation& evaluation) {
  const Accuracy& accuracy = *evaluation.accuracy;
  const DistanceSummary& d = accuracy.distance_mm;
  return Tile("Error of 14 points", fmt::format("{:.1f}", d.mean), " mm",
              fmt::format("median {:.1f}, 95 % below {:.1f}, worst {:.0f}", d.median, d.p95,
                          d.worst)) +
         Tile("Spread", fmt::format("{:.1f}", accuracy.spread_mm), " mm",
              "without each point’s own offset") +
         Tile("Error of 8 angles", fmt::format("{:.2f}", accuracy.mean_angle_rad * kDegreesPerRad),
              "°", "mean absolute") +
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
                  fmt::format("{:.2f}", precision->mean_angle_rad * kDegreesPerRad), "°",
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
                  evaluation.truth ? fmt::format("true: {:.0f} mm", evaluation.truth->stature_mm)
                                   : "as acquired");
  }
  return tiles + "</div>\n";
}

std::string ViewsSection(const Evaluation& evaluation, const TakeSamples& samples,
                         const std::vector<CameraOverlap>& overlaps) {
  std::string html;
  for (std::size_t m = 0; m < samples.moments.size(); ++m) {
    const SampledMoment& moment = samples.moments[m];
    const PoseRow& row = RowAt(evaluation, moment);
    const ViewedBody body{row, evaluation.result.body.sizes};
    std::string views;
    for (std::size_t c = 0; c < samples.cameras.size(); ++c) {
      const auto& view = moment.views[c];
      if (!view || view->image.empty()) continue;
      views += fmt::format("<div>{}{} · IoU {:.0f} %</div>",
                           CameraViewSvg(samples.cameras[c], *view, std::span(&body, 1)),
                           EscapeHtml(samples.cameras[c].name), 100 * overlaps[c].iou[m]);
    }
    if (views.empty()) continue;
    const double seconds =
        1e-9 * static_cast<double>(row.timestamp_ns - evaluation.result.poses[0].timestamp_ns);
    html += fmt::format("<h3>Frame {}, {:.2f} s, {}</h3><div class=\"views\">{}</div>\n", row.frame,
                        seconds, kCaptureStateNames[static_cast<std::size_t>(row.state)], views);
  }
  if (html.empty()) html = "<p>No frame of the take has the time of a frame of the result.</p>\n";
  return "<h2>Camera views</h2>\n<p class=\"key\">" + TrimapKey() +
         "<span><i class=\"left\"></i>the person’s left</span><span><i class=\"right\"></i>right"
         "</span></p>\n" +
         html;
}

std::optional<double> MeanUnknownShare(const TakeSamples& samples, std::size_t camera) {
  const SensorPlaneTable table(samples.cameras[camera]);
  double sum = 0;
  int count = 0;
  for (const SampledMoment& moment : samples.moments) {
    const auto& view = moment.views[camera];
    if (!view) continue;
    const Trimap& trimap = view->trimap;
    const std::optional<double> share =
        UnknownShare(moment.voxels, {&table, &trimap.person, view->X_CW, &trimap.unknown});
    sum += share.value_or(0);
    count += share.has_value();
  }
  if (count == 0) return {};
  return sum / count;
}

}  // namespace

std::vector<SampleRequest> ChooseReportMoments(const Evaluation& evaluation) {
  std::vector<std::int64_t> times_ns;
  for (const PoseRow& row : evaluation.result.poses) {
    if (evaluation.first_tracked_pose < 0 || IsTracked(row)) times_ns.push_back(row.timestamp_ns);
  }
  return ChooseReportMoments(times_ns);
}

std::vector<SampleRequest> ChooseReportMoments(std::span<const std::int64_t> times_ns) {
  const std::size_t count = std::min<std::size_t>(kCarvedMoments, times_ns.size());
  std::vector<SampleRequest> requests;
  for (std::size_t i = 0; i < count; ++i) {
    requests.push_back({times_ns[(2 * i + 1) * times_ns.size() / (2 * count)], false});
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
    overlap.unknown_share = MeanUnknownShare(samples, c);
    for (const SampledMoment& moment : samples.moments) {
      const auto& view = moment.views[c];
      overlap.iou.push_back(
          view ? OverlapOf(ProjectVoxels(moment.voxels, samples.cameras[c], view->X_CW),
                           view->trimap.person)
               : std::numeric_limits<double>::quiet_NaN());
    }
  }
  // Cameras without frames in the whole take are last.
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
  const std::string under = fmt::format(
      "{} in {:.1f} s from {} · body “{}”{}", Counted(poses.size(), "frame"), seconds,
      Counted(samples.cameras.size(), "camera"), EscapeHtml(evaluation.result.body.model),
      evaluation.truth ? "" : " · no truth: precision only, no accuracy");
  std::vector<double> frames;
  for (const SampledMoment& moment : samples.moments) {
    frames.push_back(static_cast<double>(RowAt(evaluation, moment).frame));
  }
  std::string body = Tiles(evaluation, overlaps) + StateTimeline(evaluation) +
                     ViewsSection(evaluation, samples, overlaps);
  if (evaluation.first_tracked_pose >= 0) {
    body += TrackingSections(evaluation, samples);
  } else {
    body += "<p>The person was never tracked, so there are no poses to evaluate.</p>\n";
  }
  return ReportPage(evaluation.take, under, body + OverlapSection(frames, overlaps));
}

}  // namespace mocap
