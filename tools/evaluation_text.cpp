#include "tools/evaluation_text.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <cmath>
#include <sstream>

namespace mocap {
namespace {

double Rounded(double value, int decimals) {
  const double scale = std::pow(10, decimals);
  return std::round(value * scale) / scale;
}

std::string PointName(int scored) {
  return std::string(kPointNames[static_cast<int>(kScoredPoints[scored])]);
}

std::string AccuracyText(const Accuracy& accuracy) {
  if (accuracy.frames.empty()) return "accuracy    no tracked frame has truth\n";
  const DistanceSummary& d = accuracy.distance_mm;
  std::string text = fmt::format(
      "accuracy    {:.1f} mm mean over 14 points (median {:.1f}, 95 % below {:.1f}, worst {:.1f}), "
      "{:.1f} mm without each point's own offset\n"
      "            {:.2f}° mean over 8 angles; tracked {:.1f} % from frame {} of {}; head found in "
      "{:.1f} %\n\n",
      d.mean, d.median, d.p95, d.worst, accuracy.spread_mm,
      accuracy.mean_angle_rad * kDegreesPerRadian, 100 * accuracy.tracked_share,
      accuracy.first_tracked_frame, accuracy.truth_frames, 100 * accuracy.head_found_share);
  text += fmt::format("  {:<14}{:>9}      {:<14}{:>9}\n", "point", "mm", "angle", "degrees");
  for (int i = 0; i < kScoredPointCount; ++i) {
    text += fmt::format("  {:<14}{:>9.1f}", PointName(i), accuracy.point_mm[i]);
    if (i < kScoredAngleCount) {
      text += fmt::format("      {:<14}{:>9.1f}", kScoredAngleNames[i],
                          accuracy.angle_rad[i] * kDegreesPerRadian);
    }
    text += '\n';
  }
  return text;
}

std::string LengthsText(const Evaluation& evaluation) {
  if (evaluation.lengths.empty()) return {};
  std::string text = fmt::format("\n  {:<14}{:>9}{:>9}{:>9}\n", "length", "mm", "true", "error");
  const auto add = [&](const std::string& name, double acquired_mm, double true_mm) {
    text += fmt::format("  {:<14}{:>9.1f}{:>9.1f}{:>+9.1f}\n", name, acquired_mm, true_mm,
                        acquired_mm - true_mm);
  };
  for (const LengthPair& pair : evaluation.lengths) {
    add(pair.name, pair.acquired_mm, pair.true_mm);
  }
  add("stature", evaluation.result.body.stature_mm, evaluation.truth->stature_mm);
  return text;
}

toml::table PrecisionJson(const Precision& precision) {
  toml::table angles, points;
  for (int i = 0; i < kPaperAngleCount; ++i) {
    angles.insert(fmt::format("theta_{}", i + 1),
                  Rounded(precision.angle_rad[i] * kDegreesPerRadian, 3));
  }
  for (int i = 0; i < kPointCount; ++i) {
    points.insert(kPointNames[i], Rounded(precision.point_mm[i], 2));
  }
  return toml::table{{"frames", precision.frames},
                     {"angle_mean_deg", Rounded(precision.mean_angle_rad * kDegreesPerRadian, 3)},
                     {"angle_mean_without_twist_deg",
                      Rounded(precision.mean_angle_without_twist_rad * kDegreesPerRadian, 3)},
                     {"point_mean_mm", Rounded(precision.mean_point_mm, 2)},
                     {"angles_deg", std::move(angles)},
                     {"points_mm", std::move(points)}};
}

void AddAccuracy(const Evaluation& evaluation, toml::table& json) {
  const Accuracy& accuracy = *evaluation.accuracy;
  json.insert_or_assign("frames", accuracy.truth_frames);
  json.insert_or_assign("tracked_share", Rounded(accuracy.tracked_share, 4));
  if (accuracy.frames.empty()) return;
  toml::table angles, points, lengths;
  for (int i = 0; i < kScoredAngleCount; ++i) {
    angles.insert(kScoredAngleNames[i], Rounded(accuracy.angle_rad[i] * kDegreesPerRadian, 2));
  }
  for (int i = 0; i < kScoredPointCount; ++i) {
    points.insert(PointName(i), Rounded(accuracy.point_mm[i], 1));
  }
  for (const LengthPair& pair : evaluation.lengths) {
    lengths.insert(pair.name + "_mm", Rounded(pair.acquired_mm - pair.true_mm, 1));
  }
  const DistanceSummary& d = accuracy.distance_mm;
  json.insert_or_assign("first_tracked_frame", accuracy.first_tracked_frame);
  json.insert_or_assign("mpjpe_mm", Rounded(d.mean, 1));
  json.insert_or_assign("median_mm", Rounded(d.median, 1));
  json.insert_or_assign("p95_mm", Rounded(d.p95, 1));
  json.insert_or_assign("worst_mm", Rounded(d.worst, 1));
  json.insert_or_assign("spread_mm", Rounded(accuracy.spread_mm, 1));
  json.insert_or_assign("head_found_share", Rounded(accuracy.head_found_share, 4));
  json.insert_or_assign("angle_mae_deg", Rounded(accuracy.mean_angle_rad * kDegreesPerRadian, 2));
  json.insert_or_assign("angles_deg", std::move(angles));
  json.insert_or_assign("points_mm", std::move(points));
  json.insert_or_assign("length_error_mm", std::move(lengths));
}

}  // namespace

std::string EvaluationText(const Evaluation& evaluation) {
  const BodyRecord& body = evaluation.result.body;
  std::string text =
      fmt::format("{}: {} frames, body {}, stature {:.0f} mm\n\nstates     ", evaluation.take,
                  evaluation.result.poses.size(), body.model, body.stature_mm);
  for (std::size_t i = 0; i < kCaptureStateNames.size(); ++i) {
    text += fmt::format(" {} {}{}", kCaptureStateNames[i], evaluation.frames_in_state[i],
                        i + 1 < kCaptureStateNames.size() ? "," : "\n");
  }
  if (evaluation.first_tracked_pose >= 0) {
    text += fmt::format("tracked     {:.1f} % from frame {} on; residual {:.1f} mm\n",
                        100 * evaluation.tracked_share,
                        evaluation.result.poses[evaluation.first_tracked_pose].frame,
                        evaluation.mean_residual_mm);
  }
  if (const auto& precision = evaluation.precision) {
    text += fmt::format(
        "precision   {:.2f}° mean over 16 angles, {:.2f}° without the upper arms' twist; {:.1f} mm "
        "mean over 23 points\n",
        precision->mean_angle_rad * kDegreesPerRadian,
        precision->mean_angle_without_twist_rad * kDegreesPerRadian, precision->mean_point_mm);
  } else {
    text += "precision   no run of 15 tracked frames\n";
  }
  if (evaluation.accuracy)
    return text + AccuracyText(*evaluation.accuracy) + LengthsText(evaluation);
  return text + "accuracy    the take has no truth\n";
}

std::string EvaluationJson(const Evaluation& evaluation, std::span<const CameraOverlap> overlaps) {
  toml::table states;
  for (std::size_t i = 0; i < kCaptureStateNames.size(); ++i) {
    states.insert(kCaptureStateNames[i], evaluation.frames_in_state[i]);
  }
  toml::table json{{"take", evaluation.take},
                   {"body", evaluation.result.body.model},
                   {"stature_mm", Rounded(evaluation.result.body.stature_mm, 1)},
                   {"frames", static_cast<std::int64_t>(evaluation.result.poses.size())},
                   {"states", std::move(states)},
                   {"tracked_share", Rounded(evaluation.tracked_share, 4)},
                   {"residual_mm", Rounded(evaluation.mean_residual_mm, 2)}};
  if (evaluation.accuracy) AddAccuracy(evaluation, json);
  if (evaluation.precision) json.insert("precision", PrecisionJson(*evaluation.precision));
  if (!overlaps.empty()) {
    toml::table iou;
    for (const CameraOverlap& overlap : overlaps) {
      if (overlap.frames() > 0) iou.insert(overlap.camera, Rounded(overlap.mean(), 4));
    }
    json.insert("hull_iou", std::move(iou));
  }
  std::ostringstream out;
  out << toml::json_formatter(json) << '\n';
  return out.str();
}

}  // namespace mocap
