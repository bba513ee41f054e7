#include "tools/report/report_figures.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "config/joint_names.h"
#include "core/degrees.h"
#include "tools/report/evaluation_text.h"
#include "tools/report/extremity_text.h"
#include "tools/report/report.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

std::string SideName(int side) { return side == 0 ? "left" : "right"; }

/// A value of every row; null where nobody is tracked.
template <typename Value>
Json Curve(const Evaluation& evaluation, Value value) {
  Json curve = Json::array();
  for (const PoseRow& row : evaluation.result.poses)
    curve.push_back(IsTracked(row) ? NumberOrNull(value(row)) : Json());
  return curve;
}

/// A value of every row whose error is known; null elsewhere.
template <typename Value>
Json ScoredCurve(const Evaluation& evaluation, Value value) {
  Json curve(evaluation.result.poses.size(), Json());
  if (!evaluation.accuracy) return curve;
  for (const FrameError& error : evaluation.accuracy->frames)
    curve[static_cast<std::size_t>(error.pose)] = NumberOrNull(value(error));
  return curve;
}

template <typename Value>
Json TrueCurve(const Evaluation& evaluation, Value value) {
  return ScoredCurve(evaluation, [&](const FrameError& error) {
    return value(evaluation.truth->frames[static_cast<std::size_t>(error.truth)].points_W);
  });
}

Json OverFrames(const Evaluation& evaluation, const std::string& y_label, int height, Json series) {
  return {{"x", FrameAxis(evaluation)},
          {"y", {{"label", y_label}}},
          {"height", height},
          {"shade", true},
          {"series", std::move(series)}};
}

bool IsScored(const Evaluation& evaluation) {
  return evaluation.accuracy && !evaluation.accuracy->frames.empty();
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

/// Fig. 17: estimated and true sizes of the parts 0 to 9.
Json PartSizesFigure(const Evaluation& evaluation) {
  const BodySizes& s = evaluation.result.body.sizes;
  const double acquired_mm[] = {s.torso, s.head,      s.upper_arm, s.upper_arm, s.thigh,
                                s.thigh, s.lower_arm, s.lower_arm, s.calf,      s.calf};
  const char* names[] = {"torso", "head",      "upper_arm", "upper_arm", "thigh",
                         "thigh", "lower_arm", "lower_arm", "calf",      "calf"};
  const Json labels = {"0 torso",   "1 head",        "2 upper arm L", "3 upper arm R", "4 thigh L",
                       "5 thigh R", "6 lower arm L", "7 lower arm R", "8 calf L",      "9 calf R"};
  Json truth = Json::array();
  const Json x{{"x", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}};
  for (const char* name : names) {
    const bool is_known = evaluation.truth && evaluation.truth->lengths_mm.contains(name);
    truth.push_back(is_known ? NumberOrNull(evaluation.truth->lengths_mm.at(name)) : Json());
  }
  const bool has_truth = evaluation.truth && !evaluation.truth->lengths_mm.empty();
  Json series = Json::array({Series("acquired", kLeftFigure, "dots", acquired_mm, x)});
  if (has_truth) series.push_back(Series("true", kRightFigure, "rings", truth, x));
  return Figure(
      "Part sizes",
      std::string("as in the paper’s Fig. 17. Left and right are acquired as one.") +
          (has_truth ? " Rings: true sizes; the head’s is not known."
                     : " The take does not contain the true sizes."),
      Json::array(
          {{{"x", {{"label", "body part number"}, {"range", {-0.5, 9.5}}, {"names", labels}}},
            {"y", {{"label", "length [mm]"}}},
            {"series", series}}}));
}

/// Fig. 22: hip and knee angles over the frame number.
Json HipKneeFigure(const Evaluation& evaluation) {
  const char* labels[] = {"hip about x [rad]", "hip about y [rad]", "knee about y [rad]"};
  Json plots = Json::array();
  for (int row = 0; row < 3; ++row) {
    Json series = Json::array();
    for (int side = 0; side < 2; ++side) {
      const int angle = 10 + 2 * row + side;
      series.push_back(
          Series(fmt::format("θ{} {}", angle + 1, SideName(side)), kLeftFigure + side, "line",
                 Curve(evaluation, [&](const PoseRow& p) { return p.paper.theta_rad[angle]; })));
      if (!IsScored(evaluation)) continue;
      series.push_back(Series("true", kLeftFigure + side, "dashed",
                              TrueCurve(evaluation, [&](const ScoredPoints& p) {
                                return TrueLegAngle(p, row, side);
                              })));
    }
    plots.push_back(OverFrames(evaluation, labels[row], 140, series));
  }
  return Figure("Hip and knee angles",
                "over the frame number, as in Fig. 22: θ11–θ16. Dashed: the same angles read off "
                "the true points, in a torso frame of neck and hips. Shaded: not tracked.",
                plots);
}

/// The eight angles that can be computed from points, tracked and true.
Json ScoredAnglesFigure(const Evaluation& evaluation) {
  Json plots = Json::array();
  for (int angle = 0; angle < kScoredAngleCount; ++angle) {
    const auto degrees = [angle](const ScoredPoints& p) {
      return ScoredAnglesOf(p)[angle] * kDegreesPerRad;
    };
    const int figure = kLeftFigure + angle % 2;
    plots.push_back(OverFrames(
        evaluation, fmt::format("{} [°]", kScoredAngleNames[angle]), 130,
        {Series("tracked", figure, "line",
                Curve(evaluation,
                      [&](const PoseRow& row) { return degrees(ScoredPointsOf(row.points_W)); })),
         Series("true", figure, "dashed", TrueCurve(evaluation, degrees))}));
  }
  return Figure("Angles from points alone",
                "so that no model’s axes matter: between upper and lower limb at elbow and knee, "
                "and from the torso’s axis to upper arm and thigh.",
                plots, 2);
}

void AddAccuracySections(const Evaluation& evaluation, const Json& figures, Json& sections) {
  sections.push_back(Heading("Accuracy"));
  sections.push_back(Figure(
      "Distance from the truth", "frame by frame.",
      Json::array({OverFrames(
          evaluation, "error [mm]", 160,
          {Series("mean of 14 points", kPlainFigure, "line", ErrorCurve(evaluation)),
           Series("worst", kOtherFigure, "line", ScoredCurve(evaluation, [](const FrameError& e) {
                    return e.point_mm.maxCoeff();
                  }))})})));
  Json lengths = Json::array();
  for (const LengthPair& pair : evaluation.lengths) {
    lengths.push_back({pair.name, NumberOrNull(pair.acquired_mm), NumberOrNull(pair.true_mm),
                       NumberOrNull(pair.acquired_mm - pair.true_mm)});
  }
  sections.push_back(Beside(
      {Json::array({BarTable("mean error of point", "mm", 1, figures["points_mm"])}),
       Json::array(
           {BarTable("mean error of angle", "°", 2, figures["angles_deg"]),
            Table({{"length"}, {"acquired mm", 1}, {"true mm", 1}, {"error mm", 1, false, true}},
                  lengths)})}));
  sections.push_back(ScoredAnglesFigure(evaluation));
  Append(ExtremitySections(evaluation.extremities), sections);
}

void AddPrecisionSections(const Evaluation& evaluation, const Json& figures, Json& sections) {
  sections.push_back(Heading("Precision"));
  if (!evaluation.precision) {
    sections.push_back(Paragraph("No run of 15 tracked frames."));
    return;
  }
  const Precision& precision = *evaluation.precision;
  Json angles;
  for (int i = 0; i < kPaperAngleCount; ++i) {
    angles[fmt::format("θ{} {}", i + 1, kPaperJointNames[i])] =
        NumberOrNull(precision.angle_rad[i] * kDegreesPerRad);
  }
  sections.push_back(Paragraph(fmt::format(
      "Mean absolute difference between the output and a smooth curve through it (Savitzky–Golay, "
      "order 3, 15 frames), over {} frames: what the paper gives in place of a comparison with the "
      "truth. Mean of the angles {:.2f}°; {:.2f}° without θ7 and θ8, which are undefined while an "
      "arm is straight.",
      precision.frames, precision.mean_angle_rad * kDegreesPerRad,
      precision.mean_angle_without_twist_rad * kDegreesPerRad)));
  sections.push_back(
      Beside({Json::array({BarTable("angle", "°", 2, angles)}),
              Json::array({BarTable("point", "mm", 2, figures["precision"]["points_mm"])})}));
}

/// What the tracker says of its own error, and how true that is.
void AddCertaintySections(const Evaluation& evaluation, Json& sections) {
  const Certainty& certainty = *evaluation.certainty;
  Json tiles =
      Json::array({Tile("Fit", NumberOrNull(certainty.median_fit_mm), 1, "mm",
                        fmt::format("median; 95 % below {:.1f} mm", certainty.p95_fit_mm))});
  const auto& check = certainty.check;
  if (certainty.median_deviation_mm) {
    tiles.push_back(Tile("Deviation", NumberOrNull(*certainty.median_deviation_mm), 1, "mm",
                         check && check->within_two_deviations
                             ? fmt::format("median; {:.0f} % of the errors are within twice",
                                           100 * *check->within_two_deviations)
                             : "median"));
  }
  if (check) {
    tiles.push_back(Tile("Error where the fit is better", NumberOrNull(check->better_half_mm), 1,
                         "mm", fmt::format("{:.1f} mm in the other half", check->worse_half_mm)));
  }
  sections.push_back(Heading("The tracker’s own view"));
  sections.push_back(Tiles(tiles));
  if (check && !check->probabilities.IsEmpty()) {
    Json rows = Json::array();
    for (const ProbabilityBin& bin : check->probabilities.bins) {
      rows.push_back({fmt::format("{} to {}", bin.least, bin.most), bin.frames,
                      NumberOrNull(bin.sum / bin.frames),
                      NumberOrNull(100.0 * bin.right / bin.frames)});
    }
    sections.push_back(Table({{"probability"}, {"frames", 0}, {"mean", 3}, {"right %", 1}}, rows));
    sections.push_back(Paragraph(fmt::format("Right: mean error below {:.0f} mm.", kRightPoseMm)));
  }
  const auto curve = [&](const char* label, auto value) {
    return OverFrames(evaluation, label, 110,
                      Json::array({Series("", kPlainFigure, "line", Curve(evaluation, value))}));
  };
  sections.push_back(
      Figure("Fit",
             "(residual_mm): mean distance between the body and what the cameras show. Below: "
             "voxels of the person.",
             {curve("fit [mm]", [](const PoseRow& row) { return row.residual_mm; }),
              curve("voxels", [](const PoseRow& row) { return row.voxels; })}));
}

}  // namespace

Json FrameAxis(const Evaluation& evaluation) {
  const std::vector<PoseRow>& poses = evaluation.result.poses;
  const std::int64_t first = poses.empty() ? 0 : poses.front().frame;
  Json numbers = Json::array();
  bool is_whole = true;
  for (const PoseRow& row : poses) {
    is_whole &= row.frame == first + static_cast<std::int64_t>(numbers.size());
    numbers.push_back(row.frame);
  }
  Json axis{{"label", "frame number"}};
  if (is_whole)
    axis["first"] = first;
  else
    axis["values"] = numbers;
  return axis;
}

Json ErrorCurve(const Evaluation& evaluation) {
  return ScoredCurve(evaluation, [](const FrameError& error) { return error.point_mm.mean(); });
}

Json TorsoPath(const Evaluation& evaluation, const std::string& label, int figure) {
  const auto meters = [&](int axis) {
    return Curve(evaluation,
                 [axis](const PoseRow& row) { return row.paper.torso_mm[axis] / 1000; });
  };
  return Series(label, figure, "line", meters(1), {{"x", meters(0)}});
}

Json PathsFigure(const std::string& title, const TakeSamples& samples, Json paths) {
  Json x = Json::array(), y = Json::array(), names = Json::array();
  for (const CameraCalibration& camera : samples.cameras) {
    const Vector3 p_WC = camera.X_CW.Inverse().p / 1000;
    x.push_back(NumberOrNull(p_WC.x()));
    y.push_back(NumberOrNull(p_WC.y()));
    names.push_back(camera.name);
  }
  paths.insert(paths.begin(),
               Series("camera", kOtherFigure, "rings", y, {{"x", x}, {"names", names}}));
  return Figure(title, "from above, as in Fig. 21, with the cameras.",
                Json::array({{{"x", {{"label", "world x [m]"}}},
                              {"y", {{"label", "world y [m]"}}},
                              {"equal", true},
                              {"series", paths}}}));
}

Json TrackingSections(const Evaluation& evaluation, const TakeSamples& samples) {
  const Json figures = Json::parse(EvaluationJson(evaluation, {}));
  Json paths = Json::array({TorsoPath(evaluation, "tracked", kLeftFigure)});
  if (evaluation.truth) {
    Json x = Json::array(), y = Json::array();
    for (const ScoredFrame& frame : evaluation.truth->frames) {
      const Vector3 p_W =
          (frame.points_W.col(Index(Point::kNeck)) + HipsMiddle(frame.points_W)) / 2000;
      x.push_back(NumberOrNull(p_W.x()));
      y.push_back(NumberOrNull(p_W.y()));
    }
    paths.push_back(Series("true", kRightFigure, "dashed", y, {{"x", x}}));
  }
  Json sections = {Heading("The paper’s figures"), PartSizesFigure(evaluation),
                   PathsFigure("Path of the torso’s centroid", samples, paths),
                   HipKneeFigure(evaluation)};
  if (IsScored(evaluation)) AddAccuracySections(evaluation, figures, sections);
  AddPrecisionSections(evaluation, figures, sections);
  if (evaluation.certainty) AddCertaintySections(evaluation, sections);
  return sections;
}

Json OverlapSections(std::span<const double> frames, std::span<const CameraOverlap> overlaps) {
  Json series = Json::array(), rows = Json::array(), x = Json::array();
  for (const double frame : frames) x.push_back(NumberOrNull(frame));
  for (const CameraOverlap& overlap : overlaps) {
    Json percents = Json::array();
    for (const double share : overlap.iou) percents.push_back(NumberOrNull(100 * share));
    series.push_back(Series(overlap.camera, static_cast<int>(series.size()), "line", percents));
    rows.push_back({overlap.camera, overlap.frames(), NumberOrNull(100 * overlap.mean()),
                    NumberOrNull(100 * overlap.lowest()),
                    overlap.unknown_share ? NumberOrNull(100 * *overlap.unknown_share) : Json()});
  }
  return {Heading("Voxels and silhouettes"),
          Figure("Overlap of the voxels, projected back, and the silhouettes",
                 "they were carved from: intersection over union.",
                 Json::array({{{"x", {{"label", "frame number"}, {"values", x}}},
                               {"y", {{"label", "IoU [%]"}}},
                               {"height", 160},
                               {"series", series}}})),
          Table({{"camera"}, {"frames", 0}, {"mean IoU %", 1}, {"lowest %", 1}, {"unknown %", 0}},
                rows),
          Paragraph(fmt::format("Unknown: pixels that show people, but cannot be told from the "
                                "empty studio. Segmented and carved anew for this report with "
                                "voxels of {:.0f} mm.",
                                kReportVoxelMm))};
}

}  // namespace mocap
