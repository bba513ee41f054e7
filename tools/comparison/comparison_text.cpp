#include "tools/comparison/comparison_text.h"

#include <fmt/format.h>

#include <cmath>

#include "core/degrees.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

constexpr int kComparisonDecimals = 4;

Json Number(double value) {
  return std::isfinite(value) ? Rounded(value, kComparisonDecimals) : Json();
}

Json Three(const Vector3& v, int decimals) {
  return {Rounded(v.x(), decimals), Rounded(v.y(), decimals), Rounded(v.z(), decimals)};
}

template <typename Get>
Json OfAxes(const PointComparison& point, Get get) {
  Json list = Json::array();
  for (const Agreement& axis : point.axes) list.push_back(get(axis));
  return list;
}

Json Limits(const Agreement& agreement) {
  return Json::array({Number(agreement.lower), Number(agreement.upper)});
}

Json PointJson(const PointComparison& point) {
  return {{"point", point.point},
          {"markers", point.others},
          {"frames", point.distance.count},
          {"mean_mm", Number(point.distance.bias)},
          {"rmsd_mm", Number(point.distance.rmsd)},
          {"rmsd_without_bias_mm", Number(point.rmsd_without_bias)},
          {"bias_mm", OfAxes(point, [](const Agreement& a) { return Number(a.bias); })},
          {"sd_mm", OfAxes(point, [](const Agreement& a) { return Number(a.deviation); })},
          {"limits_mm", OfAxes(point, Limits)},
          {"speed_correlation", Number(point.speed_correlation)}};
}

Json AngleJson(const AngleComparison& angle) {
  const Agreement& a = angle.agreement;
  return {{"angle", angle.angle},
          {"other", angle.other.empty() ? Json() : Json(angle.other)},
          {"frames", a.count},
          {"bias_deg", Number(a.bias)},
          {"sd_deg", Number(a.deviation)},
          {"limits_deg", Limits(a)},
          {"rmsd_deg", Number(a.rmsd)},
          {"rmsd_without_bias_deg", Number(a.rmsd_without_bias)},
          {"correlation", Number(angle.correlation)},
          {"multiple_correlation", Number(angle.multiple_correlation)}};
}

Json TransformJson(const RigidTransform& X) {
  // A turn is the arc cosine of sums of these: it has half of their digits.
  constexpr int kPrecise = 12;
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back(Three(X.R.row(i).transpose(), kPrecise));
  return {{"rotation", rows},
          {"rotation_vector_deg", Three(kDegreesPerRad * LogRotation(X.R), kComparisonDecimals)},
          {"translation_mm", Three(X.p, kComparisonDecimals)}};
}

std::string OrDash(double value, int decimals, const char* format = "{:.{}f}") {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value, decimals) : "-";
}

std::string LimitsText(const Agreement& a, int decimals) {
  return OrDash(a.lower, decimals, "{:+.{}f}") + " to " + OrDash(a.upper, decimals, "{:+.{}f}");
}

std::string BiasText(const PointComparison& point) {
  std::string text;
  for (const Agreement& axis : point.axes)
    text += (text.empty() ? "" : " ") + OrDash(axis.bias, 1, "{:+.{}f}");
  return text;
}

std::string PointsTable(const Comparison& comparison) {
  std::string text =
      fmt::format("\n{:<14}{:<22}{:>7}{:>8}{:>8}{:>10}{:>26}{:>8}\n", "point [mm]", "other",
                  "frames", "mean", "RMSD", "w/o bias", "bias ahead, left, up", "r");
  for (const PointComparison& point : comparison.points) {
    text += fmt::format("{:<14}{:<22}{:>7}{:>8}{:>8}{:>10}{:>26}{:>8}\n", point.point,
                        Shortened(OthersOf(point), 21), point.distance.count,
                        OrDash(point.distance.bias, 1), OrDash(point.distance.rmsd, 1),
                        OrDash(point.rmsd_without_bias, 1), BiasText(point),
                        OrDash(point.speed_correlation, 3));
  }
  return text;
}

std::string AnglesTable(const Comparison& comparison) {
  std::string text =
      fmt::format("\n{:<22}{:>7}{:>8}{:>8}{:>10}{:>20}{:>8}{:>8}\n", "angle [deg]", "frames",
                  "bias", "RMSD", "w/o bias", "limits of agreement", "r", "CMC");
  for (const AngleComparison& angle : comparison.angles) {
    const Agreement& a = angle.agreement;
    text += fmt::format("{:<22}{:>7}{:>8}{:>8}{:>10}{:>20}{:>8}{:>8}\n", angle.angle, a.count,
                        OrDash(a.bias, 2, "{:+.{}f}"), OrDash(a.rmsd, 2),
                        OrDash(a.rmsd_without_bias, 2), LimitsText(a, 1),
                        OrDash(angle.correlation, 3), OrDash(angle.multiple_correlation, 3));
  }
  return text;
}

}  // namespace

std::string_view NameOf(PairedBy by) {
  switch (by) {
    case PairedBy::kNames:
      return "names";
    case PairedBy::kMotion:
      return "motion";
    case PairedBy::kAngles:
      return "angles";
  }
  return "";
}

std::string OthersOf(const PointComparison& point) {
  std::string text;
  for (const std::string& other : point.others)
    text += (text.empty() ? "" : " + ") + Printable(other);
  return text;
}

std::string ComparisonText(const Comparison& comparison) {
  const Vector3 turn_deg = kDegreesPerRad * LogRotation(comparison.alignment.X.R);
  const Vector3& p = comparison.alignment.X.p;
  std::string text;
  if (!comparison.person.empty()) text += "person: " + Printable(comparison.person) + '\n';
  if (!comparison.subject.empty()) text += "subject: " + Printable(comparison.subject) + '\n';
  text += fmt::format("other: {}, {} at {:.1f} Hz\n", comparison.format,
                      Counted(comparison.other_frames, "frame"), comparison.other_rate_hz);
  text += fmt::format("offset: {:+.4f} s (added to the other's time); {} in both\n",
                      comparison.alignment.offset_s, Counted(comparison.time_s.size(), "frame"));
  text += fmt::format("transform: turn {:.2f} {:.2f} {:.2f} deg, shift {:.1f} {:.1f} {:.1f} mm\n",
                      turn_deg.x(), turn_deg.y(), turn_deg.z(), p.x(), p.y(), p.z());
  text += fmt::format("paired by: {}\n", NameOf(comparison.alignment.by));
  if (!comparison.points.empty()) {
    text += fmt::format("points: mean {:.1f} mm, RMSD {:.1f} mm, without bias {:.1f} mm\n",
                        comparison.points_mean_mm, comparison.points_rmsd_mm,
                        comparison.points_rmsd_without_bias_mm);
  }
  if (!comparison.angles.empty()) {
    text += fmt::format("angles{}: RMSD {:.2f} deg, without bias {:.2f} deg\n",
                        comparison.angles_by_points ? " (bends, from points)" : "",
                        comparison.angles_rmsd_deg, comparison.angles_rmsd_without_bias_deg);
  } else {
    text += "angles: none in common\n";
  }
  if (!comparison.points.empty()) text += PointsTable(comparison);
  if (!comparison.angles.empty()) text += AnglesTable(comparison);
  if (!comparison.not_compared.empty()) {
    text += "\nnot compared:";
    for (const std::string& name : comparison.not_compared) text += ' ' + Printable(name);
    text += '\n';
  }
  return text;
}

Json ComparisonJson(const Comparison& comparison) {
  const auto name_or_null = [](const std::string& name) {
    return name.empty() ? Json() : Json(name);
  };
  Json json = {{"person", name_or_null(comparison.person)},
               {"subject", name_or_null(comparison.subject)},
               {"other",
                {{"format", comparison.format},
                 {"frames", comparison.other_frames},
                 {"rate_hz", Number(comparison.other_rate_hz)},
                 {"seconds", Number(comparison.other_seconds)}}},
               {"offset_s", Rounded(comparison.alignment.offset_s, 6)},
               {"transform", TransformJson(comparison.alignment.X)},
               {"paired_by", std::string(NameOf(comparison.alignment.by))},
               {"frames", comparison.time_s.size()},
               {"points_mean_mm", Number(comparison.points_mean_mm)},
               {"points_rmsd_mm", Number(comparison.points_rmsd_mm)},
               {"points_rmsd_without_bias_mm", Number(comparison.points_rmsd_without_bias_mm)},
               {"angles_rmsd_deg", Number(comparison.angles_rmsd_deg)},
               {"angles_rmsd_without_bias_deg", Number(comparison.angles_rmsd_without_bias_deg)},
               {"angles_by_points", comparison.angles_by_points && !comparison.angles.empty()},
               {"points", Json::array()},
               {"angles", Json::array()},
               {"not_compared", comparison.not_compared},
               {"remarks", comparison.remarks}};
  for (const PointComparison& point : comparison.points) json["points"].push_back(PointJson(point));
  for (const AngleComparison& angle : comparison.angles) json["angles"].push_back(AngleJson(angle));
  return json;
}

}  // namespace mocap
