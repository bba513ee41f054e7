#include "tools/report/evaluation_text.h"

#include <fmt/format.h>

#include "core/degrees.h"
#include "daemon/base/json.h"
#include "drivers/printable_text.h"
#include "tools/report/extremity_text.h"

namespace mocap {
namespace {

std::string PointName(int scored) {
  return std::string(kPointNames[static_cast<int>(kScoredPoints[scored])]);
}

std::string AccuracyText(const Accuracy& accuracy) {
  if (accuracy.frames.empty()) return "accuracy    no tracked frame has truth\n";
  const DistanceSummary& d = accuracy.distance_mm;
  std::string text = fmt::format(
      "accuracy    {:.1f} mm mean over 14 points (median {:.1f}, 95 % below {:.1f}, worst {:.1f}), "
      "{:.1f} mm without each point's own offset\n"
      "            {:.2f}° mean over 8 angles; tracked {:.1f} % of {} frames with truth{}; head "
      "found "
      "in {:.1f} %\n\n",
      d.mean, d.median, d.p95, d.worst, accuracy.spread_mm,
      accuracy.mean_angle_rad * kDegreesPerRad, 100 * accuracy.tracked_share,
      accuracy.truth_frames - accuracy.first_tracked_frame,
      accuracy.first_tracked_frame == 0
          ? ""
          : fmt::format(" (after {} more in which nobody was found yet)",
                        accuracy.first_tracked_frame),
      100 * accuracy.head_found_share);
  text += fmt::format("  {:<14}{:>9}      {:<14}{:>9}\n", "point", "mm", "angle", "degrees");
  for (int i = 0; i < kScoredPointCount; ++i) {
    text += fmt::format("  {:<14}{:>9.1f}", PointName(i), accuracy.point_mm[i]);
    if (i < kScoredAngleCount) {
      text += fmt::format("      {:<14}{:>9.1f}", kScoredAngleNames[i],
                          accuracy.angle_rad[i] * kDegreesPerRad);
    }
    text += '\n';
  }
  return text;
}

std::string LengthsText(const Evaluation& evaluation) {
  if (evaluation.lengths.empty() || evaluation.first_tracked_pose < 0) return {};
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

Json PrecisionJson(const Precision& precision) {
  Json angles = Json::object(), points = Json::object(), json = Json::object();
  for (int i = 0; i < kPaperAngleCount; ++i) {
    angles[fmt::format("theta_{}", i + 1)] = Rounded(precision.angle_rad[i] * kDegreesPerRad, 3);
  }
  for (int i = 0; i < kPointCount; ++i)
    points[std::string(kPointNames[i])] = Rounded(precision.point_mm[i], 2);
  json["frames"] = precision.frames;
  json["angle_mean_deg"] = Rounded(precision.mean_angle_rad * kDegreesPerRad, 3);
  json["angle_mean_without_twist_deg"] =
      Rounded(precision.mean_angle_without_twist_rad * kDegreesPerRad, 3);
  json["point_mean_mm"] = Rounded(precision.mean_point_mm, 2);
  json["angles_deg"] = angles;
  json["points_mm"] = points;
  return json;
}

Json CertaintyJson(const Certainty& certainty) {
  Json json = Json::object();
  json["residual_median_mm"] = Rounded(certainty.median_fit_mm, 2);
  json["residual_p95_mm"] = Rounded(certainty.p95_fit_mm, 2);
  if (certainty.median_deviation_mm)
    json["deviation_median_mm"] = Rounded(*certainty.median_deviation_mm, 2);
  if (!certainty.check) return json;
  json["error_of_better_half_mm"] = Rounded(certainty.check->better_half_mm, 1);
  json["error_of_worse_half_mm"] = Rounded(certainty.check->worse_half_mm, 1);
  if (const auto& share = certainty.check->within_two_deviations)
    json["errors_within_two_deviations"] = Rounded(*share, 4);
  const ProbabilityCheck& probabilities = certainty.check->probabilities;
  if (!probabilities.IsEmpty()) json["probabilities"] = ProbabilityJson(probabilities);
  return json;
}

void AddAccuracy(const Evaluation& evaluation, Json& json) {
  const Accuracy& accuracy = *evaluation.accuracy;
  if (accuracy.frames.empty()) return;
  Json angles = Json::object(), points = Json::object(), lengths = Json::object();
  for (int i = 0; i < kScoredAngleCount; ++i) {
    angles[std::string(kScoredAngleNames[i])] = Rounded(accuracy.angle_rad[i] * kDegreesPerRad, 2);
  }
  for (int i = 0; i < kScoredPointCount; ++i)
    points[std::string(PointName(i))] = Rounded(accuracy.point_mm[i], 1);
  for (const LengthPair& pair : evaluation.lengths) {
    lengths[pair.name + "_mm"] = Rounded(pair.acquired_mm - pair.true_mm, 1);
  }
  const DistanceSummary& d = accuracy.distance_mm;
  json["mpjpe_mm"] = Rounded(d.mean, 1);
  json["median_mm"] = Rounded(d.median, 1);
  json["p95_mm"] = Rounded(d.p95, 1);
  json["worst_mm"] = Rounded(d.worst, 1);
  json["spread_mm"] = Rounded(accuracy.spread_mm, 1);
  json["head_found_share"] = Rounded(accuracy.head_found_share, 4);
  json["angle_mae_deg"] = Rounded(accuracy.mean_angle_rad * kDegreesPerRad, 2);
  json["angles_deg"] = angles;
  json["points_mm"] = points;
  json["length_error_mm"] = lengths;
}

std::string JitterText(const Evaluation& evaluation) {
  std::string text = fmt::format("jitter      {:.1f} mm mean third difference from frame to frame",
                                 *evaluation.jitter_mm);
  if (evaluation.true_jitter_mm)
    text += fmt::format("; {:.1f} mm of the true motion", *evaluation.true_jitter_mm);
  return text + "\n";
}

}  // namespace

std::string EvaluationText(const Evaluation& evaluation) {
  const BodyRecord& body = evaluation.result.body;
  const bool is_tracked = evaluation.first_tracked_pose >= 0;
  std::string text = fmt::format(
      "{}: {}, {}\n\nstates     ", Printable(evaluation.take),
      Counted(evaluation.result.poses.size(), "frame"),
      is_tracked ? fmt::format("body {}, stature {:.0f} mm", Printable(body.model), body.stature_mm)
                 : "nobody was tracked");
  for (std::size_t i = 0; i < kCaptureStateNames.size(); ++i) {
    text += fmt::format(" {} {}{}", kCaptureStateNames[i], evaluation.frames_in_state[i],
                        i + 1 < kCaptureStateNames.size() ? "," : "\n");
  }
  if (is_tracked) {
    text += fmt::format("tracked     {:.1f} % from frame {} on\n", 100 * evaluation.tracked_share,
                        evaluation.result.poses[evaluation.first_tracked_pose].frame);
  }
  if (evaluation.certainty) text += CertaintyText(*evaluation.certainty);
  if (const auto& precision = evaluation.precision) {
    text += fmt::format(
        "precision   {:.2f}° mean over 16 angles, {:.2f}° without the upper arms' twist; {:.1f} mm "
        "mean over 23 points\n",
        precision->mean_angle_rad * kDegreesPerRad,
        precision->mean_angle_without_twist_rad * kDegreesPerRad, precision->mean_point_mm);
  } else {
    text += "precision   no run of 15 tracked frames\n";
  }
  if (evaluation.jitter_mm) text += JitterText(evaluation);
  if (evaluation.accuracy)
    return text + AccuracyText(*evaluation.accuracy) + LengthsText(evaluation) +
           ExtremityText(evaluation.extremities) + ProbabilityTextOf(evaluation.certainty);
  return text + "accuracy    the take has no truth\n";
}

void AddEvaluation(const Evaluation& evaluation, Json& json) {
  const auto& accuracy = evaluation.accuracy;
  Json states = Json::object();
  for (std::size_t i = 0; i < kCaptureStateNames.size(); ++i) {
    states[std::string(kCaptureStateNames[i])] = evaluation.frames_in_state[i];
  }
  json["body"] = evaluation.result.body.model;
  const bool is_tracked = evaluation.first_tracked_pose >= 0;
  if (is_tracked) json["stature_mm"] = Rounded(evaluation.result.body.stature_mm, 1);
  json["frames"] = evaluation.result.poses.size();
  if (accuracy) json["truth_frames"] = accuracy->truth_frames;
  if (is_tracked)
    json["first_tracked_frame"] = evaluation.result.poses[evaluation.first_tracked_pose].frame;
  json["states"] = states;
  json["tracked_share"] = Rounded(accuracy ? accuracy->tracked_share : evaluation.tracked_share, 4);
  json["residual_mm"] = Rounded(evaluation.mean_residual_mm, 2);
  if (accuracy) AddAccuracy(evaluation, json);
  if (!evaluation.extremities.IsEmpty())
    json["extremities"] = ExtremityJson(evaluation.extremities);
  if (evaluation.certainty) json["certainty"] = CertaintyJson(*evaluation.certainty);
  if (evaluation.precision) json["precision"] = PrecisionJson(*evaluation.precision);
  if (evaluation.jitter_mm) json["jitter_mm"] = Rounded(*evaluation.jitter_mm, 2);
  if (evaluation.true_jitter_mm) json["true_jitter_mm"] = Rounded(*evaluation.true_jitter_mm, 2);
}

std::string EvaluationJson(const Evaluation& evaluation, std::span<const CameraOverlap> overlaps) {
  Json json = Json::object();
  json["take"] = evaluation.take;
  AddEvaluation(evaluation, json);
  if (!overlaps.empty()) {
    Json iou = Json::object(), unknown = Json::object();
    for (const CameraOverlap& overlap : overlaps) {
      if (overlap.frames() > 0) iou[overlap.camera] = Rounded(overlap.mean(), 4);
      if (overlap.unknown_share) unknown[overlap.camera] = Rounded(*overlap.unknown_share, 4);
    }
    json["hull_iou"] = iou;
    json["unknown_share"] = unknown;
  }
  return JsonText(json) + '\n';
}

}  // namespace mocap
