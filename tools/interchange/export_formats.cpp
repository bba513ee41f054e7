#include <algorithm>
#include <array>

#include "core/errors.h"
#include "drivers/printable_text.h"
#include "tools/interchange/bvh_writer.h"
#include "tools/interchange/c3d_writer.h"
#include "tools/interchange/csv_writer.h"
#include "tools/interchange/export_format.h"
#include "tools/interchange/glb_writer.h"
#include "tools/interchange/mot_writer.h"
#include "tools/interchange/trc_writer.h"

namespace mocap {
namespace {

constexpr std::array kFormats = {
    ExportFormat{"bvh", "animation: Blender, three.js (cm, degrees, y up)", "HIERARCHY", false,
                 WriteBvh},
    ExportFormat{"glb", "glTF 2.0, animated body: Blender, three.js, viewers (m, y up)", "glTF",
                 false, WriteGlb},
    ExportFormat{"c3d", "biomechanics: Visual3D, Mokka, Motive (mm, degrees, z up)", "\x02\x50",
                 true, WriteC3d},
    ExportFormat{"mot", "OpenSim joint angles, as from inverse kinematics (degrees, m, y up)",
                 "Coordinates\nversion=1", false, WriteMot},
    ExportFormat{"trc", "OpenSim markers, for scaling and inverse kinematics (mm, y up)",
                 "PathFileType", true, WriteTrc},
    ExportFormat{"csv", "spreadsheets and scripts (mm, angles in degrees, z up as in the studio)",
                 "time_s,utime_us,", false, WriteCsv},
};

}  // namespace

std::string ExportScene::LabelPrefix(const ExportSubject& subject) const {
  return is_of_all ? Printable(subject.name) + ':' : "";
}

std::span<const ExportFormat> ExportFormats() { return kFormats; }

const ExportFormat& FindExportFormat(std::string_view name) {
  const auto format = std::ranges::find(kFormats, name, &ExportFormat::name);
  if (format == kFormats.end()) throw SetupError(std::string(name) + ": is not an export format");
  return *format;
}

}  // namespace mocap
