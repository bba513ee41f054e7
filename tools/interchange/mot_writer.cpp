#include "tools/interchange/mot_writer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <ostream>
#include <span>
#include <string_view>
#include <vector>

#include "core/degrees.h"
#include "core/errors.h"
#include "drivers/printable_text.h"
#include "tools/kinematics/joint_angles.h"
#include "tools/results/fixed_text.h"

namespace mocap {
namespace {

/// All coordinates of the model, in its order. Those named _beta move the patellas as the knees
/// bend.
constexpr std::array<std::string_view, 39> kModelCoordinates = {
    "pelvis_tilt",      "pelvis_list",  "pelvis_rotation",   "pelvis_tx",
    "pelvis_ty",        "pelvis_tz",    "hip_flexion_r",     "hip_adduction_r",
    "hip_rotation_r",   "knee_angle_r", "knee_angle_r_beta", "ankle_angle_r",
    "subtalar_angle_r", "mtp_angle_r",  "hip_flexion_l",     "hip_adduction_l",
    "hip_rotation_l",   "knee_angle_l", "knee_angle_l_beta", "ankle_angle_l",
    "subtalar_angle_l", "mtp_angle_l",  "lumbar_extension",  "lumbar_bending",
    "lumbar_rotation",  "arm_flex_r",   "arm_add_r",         "arm_rot_r",
    "elbow_flex_r",     "pro_sup_r",    "wrist_flex_r",      "wrist_dev_r",
    "arm_flex_l",       "arm_add_l",    "arm_rot_l",         "elbow_flex_l",
    "pro_sup_l",        "wrist_flex_l", "wrist_dev_l"};

constexpr std::array<std::string_view, 3> kPelvisPlace = {"pelvis_tx", "pelvis_ty", "pelvis_tz"};

using MotValues = std::array<double, kModelCoordinates.size()>;

/// In degrees and metres; NaN: not measured.
MotValues ValuesOf(const BodyAngles& angles) {
  const auto rad = CoordinatesOf(angles);
  const auto value = [&](std::string_view name) {
    const auto place = std::ranges::find(kPelvisPlace, name);
    if (place != kPelvisPlace.end()) return angles.p_GPelvis[place - kPelvisPlace.begin()];
    const std::string_view own = name.substr(0, name.find("_beta"));
    const auto coordinate = std::ranges::find(kCoordinateNames, own);
    if (coordinate == kCoordinateNames.end()) return std::nan("");
    return kDegreesPerRad * rad[static_cast<std::size_t>(coordinate - kCoordinateNames.begin())];
  };
  MotValues values;
  std::ranges::transform(kModelCoordinates, values.begin(), value);
  return values;
}

std::string MotHeader(std::size_t rows, const std::optional<std::string>& filter) {
  return fmt::format(
      "Coordinates\nversion=1\nnRows={}\nnColumns={}\ninDegrees=yes\n\n"
      "Units are S.I. units (second, meters, Newtons, ...)\n"
      "If the header above contains a line with 'inDegrees', this indicates whether rotational "
      "values are in degrees (yes) or radians (no).\n{}\nendheader\ntime\t{}\n",
      rows, 1 + kModelCoordinates.size(), filter ? "Filter: " + *filter + "\n" : "",
      fmt::join(kModelCoordinates, "\t"));
}

std::string MotRow(const MotValues& values, double time_s) {
  std::string line = FixedText(time_s, 6);
  for (const double value : values) line += '\t' + FixedText(value, 6);
  return line + '\n';
}

/// What a file has in place of unknown values.
struct FilledIn {
  std::vector<std::string_view> zeros;  ///< Coordinates that no frame shows.
  std::size_t held_frames = 0;          ///< Frames without a coordinate that others show.
};

/// Replaces the unknown values of a coordinate that some rows know, each by the last known one
/// before it, or else by the first one.
void HoldKnown(std::span<MotValues> rows, std::size_t coordinate, std::size_t first_known) {
  double last = rows[first_known][coordinate];
  for (MotValues& row : rows) {
    double& value = row[coordinate];
    if (std::isnan(value)) value = last;
    last = value;
  }
}

FilledIn FillIn(std::span<MotValues> rows) {
  FilledIn filled;
  std::vector<bool> is_held(rows.size());
  for (std::size_t i = 0; i < kModelCoordinates.size(); ++i) {
    const auto is_known = [i](const MotValues& row) { return !std::isnan(row[i]); };
    const auto known = std::ranges::find_if(rows, is_known);
    if (known == rows.end()) {
      filled.zeros.push_back(kModelCoordinates[i]);
      for (MotValues& row : rows) row[i] = 0;
      continue;
    }
    for (std::size_t k = 0; k < rows.size(); ++k) is_held[k] = is_held[k] || !is_known(rows[k]);
    HoldKnown(rows, i, static_cast<std::size_t>(known - rows.begin()));
  }
  filled.held_frames = static_cast<std::size_t>(std::ranges::count(is_held, true));
  return filled;
}

}  // namespace

ExportRemarks WriteMot(const ExportScene& scene, std::ostream& out) {
  const Result& result = scene.subjects.front().result;
  const std::vector<BodyAngles> frames = AnglesOf(result);
  if (frames.empty()) throw SetupError("no frame of the result is tracked; expected at least one");
  std::vector<MotValues> rows;
  std::ranges::transform(frames, std::back_inserter(rows), ValuesOf);
  const std::int64_t first_ns = scene.moments.front().timestamp_ns;
  const FilledIn filled = FillIn(rows);
  out << MotHeader(rows.size(), result.filter);
  for (std::size_t i = 0; i < rows.size(); ++i)
    out << MotRow(rows[i], 1e-9 * static_cast<double>(frames[i].time_ns - first_ns));
  ExportRemarks remarks = {
      fmt::format("not measured, and 0 in the file: {}", fmt::join(filled.zeros, ", "))};
  if (filled.held_frames > 0) {
    remarks.push_back(Counted(filled.held_frames, "frame") +
                      " without feet or hands; their last angles are held");
  }
  const std::size_t untracked = result.poses.size() - frames.size();
  if (untracked > 0) {
    remarks.push_back(Counted(untracked, "frame") + (untracked == 1
                                                         ? " is not tracked and has no row"
                                                         : " are not tracked and have no row"));
  }
  return remarks;
}

}  // namespace mocap
