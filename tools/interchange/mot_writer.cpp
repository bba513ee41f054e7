#include "tools/interchange/mot_writer.h"

#include <fmt/format.h>

#include <array>
#include <ostream>

#include "core/errors.h"
#include "tools/interchange/joint_angles.h"
#include "tools/results/fixed_text.h"

namespace mocap {
namespace {

constexpr std::array kColumns = {"time",
                                 "pelvis_tilt",
                                 "pelvis_list",
                                 "pelvis_rotation",
                                 "pelvis_tx",
                                 "pelvis_ty",
                                 "pelvis_tz",
                                 "hip_flexion_r",
                                 "hip_adduction_r",
                                 "hip_rotation_r",
                                 "knee_angle_r",
                                 "hip_flexion_l",
                                 "hip_adduction_l",
                                 "hip_rotation_l",
                                 "knee_angle_l",
                                 "lumbar_extension",
                                 "lumbar_bending",
                                 "lumbar_rotation",
                                 "arm_flex_r",
                                 "arm_add_r",
                                 "arm_rot_r",
                                 "elbow_flex_r",
                                 "arm_flex_l",
                                 "arm_add_l",
                                 "arm_rot_l",
                                 "elbow_flex_l"};

std::string MotHeader(std::size_t rows) {
  std::string text = fmt::format(
      "Coordinates\nversion=1\nnRows={}\nnColumns={}\ninDegrees=yes\n\n"
      "Units are S.I. units (second, meters, Newtons, ...)\n"
      "If the header above contains a line with 'inDegrees', this indicates whether rotational "
      "values are in degrees (yes) or radians (no).\n\nendheader\n",
      rows, kColumns.size());
  for (const char* column : kColumns)
    text += fmt::format("{}{}", column == kColumns[0] ? "" : "\t", column);
  return text + '\n';
}

class Line {
 public:
  explicit Line(double time_s) : text_(FixedText(time_s, 6)) {}
  void Angle(double rad) { text_ += '\t' + FixedText(kDegreesPerRad * rad, 5); }
  void Angles(const Vector3& rad) {
    for (const double angle : rad) Angle(angle);
  }
  void Limb(const LimbAngles& limb) {
    Angles({limb.flexion, limb.adduction, limb.rotation});
    Angle(limb.bend);
  }
  void Metres(const Vector3& m) {
    for (const double metres : m) text_ += '\t' + FixedText(metres, 6);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace

ExportRemarks WriteMot(const ExportScene& scene, std::ostream& out) {
  const Result& result = scene.subjects.front().result;
  const std::vector<BodyAngles> frames = AnglesOf(result);
  if (frames.empty()) throw SetupError("no frame of the result is tracked; expected at least one");
  out << MotHeader(frames.size());
  const std::int64_t first_ns = scene.moments.front().timestamp_ns;
  for (const BodyAngles& angles : frames) {
    Line line(1e-9 * static_cast<double>(angles.time_ns - first_ns));
    line.Angles(angles.pelvis);
    line.Metres(angles.p_GPelvis);
    line.Limb(angles.leg_r);
    line.Limb(angles.leg_l);
    line.Angles(angles.lumbar);
    line.Limb(angles.arm_r);
    line.Limb(angles.arm_l);
    out << line.text() << '\n';
  }
  const std::size_t untracked = result.poses.size() - frames.size();
  if (untracked == 0) return {};
  return {fmt::format("frames not tracked, which have no row: {}", untracked)};
}

}  // namespace mocap
