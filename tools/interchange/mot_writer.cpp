#include "tools/interchange/mot_writer.h"

#include <fmt/format.h>

#include <ostream>

#include "core/degrees.h"
#include "core/errors.h"
#include "drivers/printable_text.h"
#include "tools/kinematics/joint_angles.h"
#include "tools/results/fixed_text.h"

namespace mocap {
namespace {

/// The pelvis' place follows its turns, as in the model.
constexpr std::size_t kPelvisTurns = 3;

std::string MotHeader(std::size_t rows) {
  std::string text = fmt::format(
      "Coordinates\nversion=1\nnRows={}\nnColumns={}\ninDegrees=yes\n\n"
      "Units are S.I. units (second, meters, Newtons, ...)\n"
      "If the header above contains a line with 'inDegrees', this indicates whether rotational "
      "values are in degrees (yes) or radians (no).\n\nendheader\ntime",
      rows, 1 + kCoordinateNames.size() + 3);
  for (std::size_t i = 0; i < kCoordinateNames.size(); ++i) {
    if (i == kPelvisTurns) text += "\tpelvis_tx\tpelvis_ty\tpelvis_tz";
    text += fmt::format("\t{}", kCoordinateNames[i]);
  }
  return text + '\n';
}

std::string MotRow(const BodyAngles& angles, std::int64_t first_ns) {
  std::string line = FixedText(1e-9 * static_cast<double>(angles.time_ns - first_ns), 6);
  const auto values_rad = CoordinatesOf(angles);
  for (std::size_t i = 0; i < values_rad.size(); ++i) {
    if (i == kPelvisTurns) {
      for (const double metres : angles.p_GPelvis) line += '\t' + FixedText(metres, 6);
    }
    line += '\t' + FixedText(kDegreesPerRad * values_rad[i], 5);
  }
  return line + '\n';
}

}  // namespace

ExportRemarks WriteMot(const ExportScene& scene, std::ostream& out) {
  const Result& result = scene.subjects.front().result;
  const std::vector<BodyAngles> frames = AnglesOf(result);
  if (frames.empty()) throw SetupError("no frame of the result is tracked; expected at least one");
  out << MotHeader(frames.size());
  const std::int64_t first_ns = scene.moments.front().timestamp_ns;
  for (const BodyAngles& angles : frames) out << MotRow(angles, first_ns);
  const std::size_t untracked = result.poses.size() - frames.size();
  if (untracked == 0) return {};
  return {Counted(untracked, "frame") +
          (untracked == 1 ? " is not tracked and has no row" : " are not tracked and have no row")};
}

}  // namespace mocap
