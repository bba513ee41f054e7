#include "tools/report/report_figures.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/degrees.h"
#include "tools/report/svg_plot.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

// Left and right keep their colours throughout the report.
constexpr int kLeftColor = 0, kRightColor = 1, kPlainColor = 2, kOtherColor = 3;

std::string Figure(const std::string& content, const std::string& caption) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", content, caption);
}

Vector2 FrameRange(const Evaluation& evaluation) {
  const std::vector<PoseRow>& poses = evaluation.result.poses;
  if (poses.empty()) return {0, 1};
  const auto first = static_cast<double>(poses.front().frame);
  return {first, std::max(first + 1, static_cast<double>(poses.back().frame))};
}

/// Ranges of frames without tracking.
std::vector<std::pair<double, double>> Untracked(const Evaluation& evaluation) {
  std::vector<std::pair<double, double>> stretches;
  for (const PoseRow& row : evaluation.result.poses) {
    if (IsTracked(row)) continue;
    const auto frame = static_cast<double>(row.frame);
    if (stretches.empty() || stretches.back().second < frame - 0.5) {
      stretches.emplace_back(frame - 0.5, frame + 0.5);
    } else {
      stretches.back().second = frame + 0.5;
    }
  }
  return stretches;
}

PlotAxes OverFrames(const Evaluation& evaluation, const std::string& y_label, int width,
                    int height) {
  PlotAxes axes{"frame number", y_label, width, height};
  axes.x_range = FrameRange(evaluation);
  axes.shaded = Untracked(evaluation);
  return axes;
}

/// A value of every tracked frame over the frame number; NaN elsewhere.
template <typename Value>
std::vector<Vector2> Curve(const Evaluation& evaluation, Value value) {
  std::vector<Vector2> points;
  for (const PoseRow& row : evaluation.result.poses) {
    points.emplace_back(static_cast<double>(row.frame), IsTracked(row) ? value(row) : kPlotGap);
  }
  return points;
}

/// A value of the truth for every tracked frame; NaN elsewhere.
template <typename Value>
std::vector<Vector2> TrueCurve(const Evaluation& evaluation, Value value) {
  std::vector<Vector2> points;
  if (!evaluation.accuracy) return points;
  for (const FrameError& error : evaluation.accuracy->frames) {
    const auto frame = static_cast<double>(evaluation.result.poses[error.pose].frame);
    if (!points.empty() && frame > points.back().x() + 1.5)
      points.emplace_back(frame - 1, kPlotGap);
    points.emplace_back(frame, value(evaluation.truth->frames[error.truth].points_W));
  }
  return points;
}

constexpr int Index(Point point) {
  for (int i = 0; i < kScoredPointCount; ++i) {
    if (kScoredPoints[i] == point) return i;
  }
  return -1;
}

Vector3 HipsMiddle(const ScoredPoints& p) {
  return (p.col(Index(Point::kHipL)) + p.col(Index(Point::kHipR))) / 2;
}

/// Direction of a true thigh in a torso frame defined by hips and neck.
Vector3 ThighInTorso(const ScoredPoints& p, int side) {
  const Vector3 up = (p.col(Index(Point::kNeck)) - HipsMiddle(p)).normalized();
  const Vector3 hips = p.col(Index(Point::kHipL)) - p.col(Index(Point::kHipR));
  const Vector3 left = (hips - up * up.dot(hips)).normalized();
  const Vector3 thigh =
      (p.col(Index(Point::kKneeL) + side) - p.col(Index(Point::kHipL) + side)).normalized();
  return {left.cross(up).dot(thigh), left.dot(thigh), up.dot(thigh)};
}

/// Angle `row` (0: hip about x, 1: hip about y, 2: knee) of a side, from true points.
double TrueLegAngle(const ScoredPoints& p, int row, int side) {
  const Vector3 thigh = ThighInTorso(p, side);
  if (row == 0) return std::atan2(thigh.y(), -thigh.z());
  if (row == 1) return -std::asin(std::clamp(thigh.x(), -1.0, 1.0));
  return std::numbers::pi - ScoredAnglesOf(p)[2 + side];
}

std::string OfParts(const Evaluation& evaluation, std::vector<PlotSeries>& series) {
  const BodySizes& s = evaluation.result.body.sizes;
  const double acquired[kBodyPartCount] = {s.torso, s.head,      s.upper_arm, s.upper_arm, s.thigh,
                                           s.thigh, s.lower_arm, s.lower_arm, s.calf,      s.calf};
  const char* names[kBodyPartCount] = {"torso", "head",      "upper_arm", "upper_arm", "thigh",
                                       "thigh", "lower_arm", "lower_arm", "calf",      "calf"};
  PlotSeries estimated{"acquired", {}, kLeftColor, PlotMark::kDots};
  PlotSeries truth{"true", {}, kRightColor, PlotMark::kRings};
  for (int part = 0; part < kBodyPartCount; ++part) {
    estimated.points.emplace_back(part, acquired[part]);
    if (!evaluation.truth) continue;
    const auto found = evaluation.truth->lengths_mm.find(names[part]);
    if (found != evaluation.truth->lengths_mm.end()) truth.points.emplace_back(part, found->second);
  }
  series.push_back(std::move(estimated));
  if (truth.points.empty()) return " The take does not contain the true sizes.";
  series.push_back(std::move(truth));
  return " Rings: true sizes; the head’s is not known.";
}

}  // namespace

std::string StateTimeline(const Evaluation& evaluation) {
  const std::vector<PoseRow>& poses = evaluation.result.poses;
  const double width = 1000.0 / std::max<std::size_t>(1, poses.size());
  std::string svg = "<svg class=\"timeline\" viewBox=\"0 0 1000 26\" preserveAspectRatio=\"none\">";
  for (std::size_t i = 0; i < poses.size();) {
    std::size_t end = i;
    while (end < poses.size() && poses[end].state == poses[i].state) ++end;
    const std::string_view name = kCaptureStateNames[static_cast<std::size_t>(poses[i].state)];
    svg += fmt::format(
        "<rect class=\"{0}\" x=\"{1:.2f}\" width=\"{2:.2f}\" height=\"26\"><title>{0}: frames {3} "
        "to {4}</title></rect>",
        name, width * static_cast<double>(i), width * static_cast<double>(end - i), poses[i].frame,
        poses[end - 1].frame);
    i = end;
  }
  svg += "</svg><p class=\"key\">";
  for (std::size_t i = 0; i < kCaptureStateNames.size(); ++i) {
    svg += fmt::format("<span><i class=\"{0}\"></i>{0} {1}</span>", kCaptureStateNames[i],
                       evaluation.frames_in_state[i]);
  }
  return svg + fmt::format("<span>of {} frames</span></p>\n", poses.size());
}

std::string PartSizesFigure(const Evaluation& evaluation) {
  std::vector<PlotSeries> series;
  const std::string note = OfParts(evaluation, series);
  PlotAxes axes{"body part number", "length [mm]", 900, 280};
  axes.x_range = Vector2(-0.5, 9.5);
  axes.x_names = {"0 torso",   "1 head",        "2 upper arm L", "3 upper arm R", "4 thigh L",
                  "5 thigh R", "6 lower arm L", "7 lower arm R", "8 calf L",      "9 calf R"};
  return Figure(
      PlotSvg(axes, series),
      "<b>Part sizes</b> as in the paper’s Fig. 17. Left and right are acquired as one." + note);
}

std::string TorsoPathFigure(const Evaluation& evaluation,
                            std::span<const std::pair<std::string, Vector3>> cameras) {
  const auto from_above = [](const Vector3& p_W) { return Vector2(p_W.head<2>() / 1000); };
  PlotSeries seats{"camera", {}, kOtherColor, PlotMark::kRings};
  for (const auto& [name, p_WC] : cameras) {
    seats.points.push_back(from_above(p_WC));
    seats.names.push_back(name);
  }
  PlotSeries truth{"true", {}, kRightColor, PlotMark::kDashed};
  if (evaluation.truth) {
    for (const ScoredFrame& frame : evaluation.truth->frames) {
      const Vector3 neck = frame.points_W.col(Index(Point::kNeck));
      truth.points.push_back(from_above((neck + HipsMiddle(frame.points_W)) / 2));
    }
  }
  PlotSeries path{"tracked", {}, kLeftColor};
  for (const PoseRow& row : evaluation.result.poses) {
    path.points.push_back(IsTracked(row) ? from_above(row.paper.torso_mm)
                                         : Vector2(kPlotGap, kPlotGap));
  }
  std::vector<PlotSeries> series = {std::move(seats), std::move(path)};
  if (!truth.points.empty()) series.push_back(std::move(truth));
  PlotAxes axes{"world x [m]", "world y [m]", 560, 520};
  axes.equal_scales = true;
  return Figure(PlotSvg(axes, series),
                "<b>Path of the torso’s centroid</b> from above, as in Fig. 21, with the cameras.");
}

std::string HipKneeFigure(const Evaluation& evaluation) {
  const char* labels[] = {"hip about x [rad]", "hip about y [rad]", "knee about y [rad]"};
  std::string plots;
  for (int row = 0; row < 3; ++row) {
    std::vector<PlotSeries> series;
    for (int side = 0; side < 2; ++side) {
      const int angle = 10 + 2 * row + side;
      const int color = side == 0 ? kLeftColor : kRightColor;
      series.push_back(
          {fmt::format("θ{} {}", angle + 1, side == 0 ? "left" : "right"),
           Curve(evaluation, [&](const PoseRow& pose) { return pose.paper.theta_rad[angle]; }),
           color});
      const auto truth =
          TrueCurve(evaluation, [&](const ScoredPoints& p) { return TrueLegAngle(p, row, side); });
      if (!truth.empty()) {
        series.push_back({side == 0 ? "" : "true", truth, color, PlotMark::kDashed});
      }
    }
    plots += PlotSvg(OverFrames(evaluation, labels[row], 900, 200), series);
  }
  return Figure(plots,
                "<b>Hip and knee angles</b> over the frame number, as in Fig. 22: θ11–θ16. Dashed: "
                "the same angles read off the true points, in a torso frame of neck and hips. "
                "Shaded: not tracked.");
}

std::string ScoredAnglesFigure(const Evaluation& evaluation) {
  if (!evaluation.accuracy) return {};
  std::string plots = "<div class=\"two\">";
  for (int angle = 0; angle < kScoredAngleCount; ++angle) {
    const int color = angle % 2 == 0 ? kLeftColor : kRightColor;
    const auto degrees = [angle](const ScoredPoints& p) {
      return ScoredAnglesOf(p)[angle] * kDegreesPerRad;
    };
    const std::vector<PlotSeries> series = {
        {"tracked",
         Curve(evaluation,
               [&](const PoseRow& row) { return degrees(ScoredPointsOf(row.points_W)); }),
         color},
        {"true", TrueCurve(evaluation, degrees), color, PlotMark::kDashed}};
    plots += PlotSvg(
        OverFrames(evaluation, fmt::format("{} [°]", kScoredAngleNames[angle]), 560, 190), series);
  }
  return Figure(
      plots + "</div>",
      "<b>Angles from points alone</b>, so that no model’s axes matter: between upper and "
      "lower limb at elbow and knee, and from the torso’s axis to upper arm and thigh.");
}

std::string ErrorFigure(const Evaluation& evaluation) {
  if (!evaluation.accuracy) return {};
  PlotSeries mean{"mean of 14 points", {}, kPlainColor}, worst{"worst", {}, kOtherColor};
  for (const FrameError& error : evaluation.accuracy->frames) {
    const auto frame = static_cast<double>(evaluation.result.poses[error.pose].frame);
    if (!mean.points.empty() && frame > mean.points.back().x() + 1.5) {
      mean.points.emplace_back(frame - 1, kPlotGap);
      worst.points.emplace_back(frame - 1, kPlotGap);
    }
    mean.points.emplace_back(frame, error.point_mm.mean());
    worst.points.emplace_back(frame, error.point_mm.maxCoeff());
  }
  const PlotSeries series[] = {mean, worst};
  return Figure(PlotSvg(OverFrames(evaluation, "error [mm]", 900, 220), series),
                "<b>Distance from the truth</b>, frame by frame.");
}

std::string ResidualFigure(const Evaluation& evaluation) {
  const PlotSeries residual[] = {
      {"", Curve(evaluation, [](const PoseRow& row) { return row.residual_mm; }), kPlainColor}};
  const PlotSeries voxels[] = {
      {"", Curve(evaluation, [](const PoseRow& row) { return row.voxels; }), kPlainColor}};
  return Figure(PlotSvg(OverFrames(evaluation, "fit [mm]", 900, 170), residual) +
                    PlotSvg(OverFrames(evaluation, "voxels", 900, 170), voxels),
                "<b>Fit</b> (residual_mm): mean distance between the body and what the cameras "
                "show. Below: voxels of the person.");
}

std::string OverlapFigure(std::span<const CameraOverlap> overlaps, std::span<const double> frames) {
  std::vector<PlotSeries> series;
  for (const CameraOverlap& overlap : overlaps) {
    PlotSeries& camera = series.emplace_back();
    camera.label = overlap.camera;
    camera.color = static_cast<int>(series.size()) - 1;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      camera.points.emplace_back(frames[i], 100 * overlap.iou[i]);
    }
  }
  PlotAxes axes{"frame number", "IoU [%]", 900, 220};
  return Figure(
      PlotSvg(axes, series),
      "<b>Overlap of the voxels, projected back, and the silhouettes</b> they were carved "
      "from: intersection over union.");
}

}  // namespace mocap
