#include "tools/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/degrees.h"
#include "core/reconstruction/carving/unknown_share.h"
#include "drivers/printable_text.h"
#include "tools/report/report_figures.h"
#include "tools/report/report_pictures.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

constexpr int kCarvedMoments = 20;
constexpr int kShownMoments = 4;

/// The result's row at a sampled moment.
const PoseRow& RowAt(const Evaluation& evaluation, const SampledMoment& moment) {
  return *std::ranges::find(evaluation.result.poses, moment.timestamp_ns, &PoseRow::timestamp_ns);
}

void AddAccuracyTiles(const Accuracy& accuracy, Json& tiles) {
  const DistanceSummary& d = accuracy.distance_mm;
  tiles.push_back(Tile(
      "Error of 14 points", NumberOrNull(d.mean), 1, "mm",
      fmt::format("median {:.1f}, 95 % below {:.1f}, worst {:.0f}", d.median, d.p95, d.worst)));
  tiles.push_back(
      Tile("Spread", NumberOrNull(accuracy.spread_mm), 1, "mm", "without each point’s own offset"));
  tiles.push_back(Tile("Error of 8 angles", NumberOrNull(accuracy.mean_angle_rad * kDegreesPerRad),
                       2, "°", "mean absolute"));
  tiles.push_back(Tile("Head found", NumberOrNull(100 * accuracy.head_found_share), 1, "%",
                       fmt::format("within {:.0f} mm", kHeadFoundMm)));
}

Json TilesOf(const Evaluation& evaluation, const std::vector<CameraOverlap>& overlaps) {
  const int first = evaluation.first_tracked_pose;
  Json tiles = Json::array();
  if (evaluation.accuracy && !evaluation.accuracy->frames.empty())
    AddAccuracyTiles(*evaluation.accuracy, tiles);
  tiles.push_back(Tile(
      "Tracked", NumberOrNull(100 * evaluation.tracked_share), 1, "%",
      first < 0 ? "never" : fmt::format("from frame {} on", evaluation.result.poses[first].frame)));
  if (const auto& precision = evaluation.precision) {
    tiles.push_back(Tile("Precision of angles",
                         NumberOrNull(precision->mean_angle_rad * kDegreesPerRad), 2, "°",
                         "against the smoothed curve"));
    tiles.push_back(Tile("Precision of points", NumberOrNull(precision->mean_point_mm), 1, "mm",
                         "against the smoothed path"));
  }
  double overlap = 0;
  for (const CameraOverlap& one : overlaps) overlap += 100 * one.mean();
  if (!overlaps.empty()) {
    tiles.push_back(Tile("Hull overlap",
                         NumberOrNull(overlap / static_cast<double>(overlaps.size())), 1, "%",
                         "voxels against silhouettes, IoU"));
  }
  if (first >= 0) {
    tiles.push_back(Tile("Stature", NumberOrNull(evaluation.result.body.stature_mm), 0, "mm",
                         evaluation.truth
                             ? fmt::format("true: {:.0f} mm", evaluation.truth->stature_mm)
                             : "as acquired"));
  }
  return Tiles(tiles);
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

Json StateBand(const std::string& name, int figure, const Evaluation& evaluation) {
  Json states = Json::array();
  for (const PoseRow& row : evaluation.result.poses) states.push_back(static_cast<int>(row.state));
  return {{"name", name},
          {"figure", figure},
          {"x", FrameAxis(evaluation)},
          {"states", std::move(states)}};
}

Json StateBands(Json people) { return {{"type", "states"}, {"people", std::move(people)}}; }

std::string ReportHtml(const Evaluation& evaluation, const TakeSamples& samples,
                       const std::vector<CameraOverlap>& overlaps) {
  const std::vector<PoseRow>& poses = evaluation.result.poses;
  const double seconds =
      poses.empty()
          ? 0
          : 1e-9 * static_cast<double>(poses.back().timestamp_ns - poses.front().timestamp_ns);
  const std::string under =
      fmt::format("{} in {:.1f} s from {} · body “{}”{}", Counted(poses.size(), "frame"), seconds,
                  Counted(samples.cameras.size(), "camera"), evaluation.result.body.model,
                  evaluation.truth ? "" : " · no truth: precision only, no accuracy");
  std::vector<double> frames;
  for (const SampledMoment& moment : samples.moments)
    frames.push_back(static_cast<double>(RowAt(evaluation, moment).frame));
  Json sections = {TilesOf(evaluation, overlaps),
                   StateBands(Json::array({StateBand("", kPlainFigure, evaluation)})),
                   Heading("Camera views")};
  sections.push_back(PictureSection(
      samples, overlaps, poses.empty() ? 0 : poses.front().timestamp_ns, [&](std::int64_t time_ns) {
        const auto row = std::ranges::find(poses, time_ns, &PoseRow::timestamp_ns);
        return std::vector<ViewedBody>{{*row, evaluation.result.body.sizes}};
      }));
  if (evaluation.first_tracked_pose >= 0)
    Append(TrackingSections(evaluation, samples), sections);
  else
    sections.push_back(
        Paragraph("The person was never tracked, so there are no poses to evaluate."));
  Append(OverlapSections(frames, overlaps), sections);
  return ReportHtml(evaluation.take, under, sections);
}

}  // namespace mocap
