#include "tools/results/trc_writer.h"

#include <fmt/format.h>

#include <limits>
#include <ostream>

#include "drivers/printable_text.h"
#include "tools/results/export_axes.h"
#include "tools/results/fixed_text.h"

namespace mocap {
namespace {

std::string Header(const Result& result, const std::string& file_name) {
  const double rate = 1 / FitClock(result.poses).period_s;
  const std::size_t frames = result.poses.size();
  std::string text = fmt::format(
      "PathFileType\t4\t(X/Y/Z)\t{}\n"
      "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
      "OrigNumFrames\n"
      "{:.6f}\t{:.6f}\t{}\t{}\tmm\t{:.6f}\t1\t{}\n",
      Printable(file_name), rate, rate, frames, kPointCount, rate, frames);
  text += "Frame#\tTime";
  for (const std::string_view name : kPointNames) text += fmt::format("\t{}\t\t", name);
  text += "\n\t";
  for (int i = 1; i <= kPointCount; ++i) text += fmt::format("\tX{0}\tY{0}\tZ{0}", i);
  return text + "\n\n";
}

}  // namespace

void WriteTrc(const Result& result, const std::string& file_name, std::ostream& out) {
  out << Header(result, file_name);
  const Matrix3 R_YW = YUpFromWorld();
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    const PoseRow& row = result.poses[i];
    const auto since_first_ns =
        static_cast<double>(row.timestamp_ns - result.poses.front().timestamp_ns);
    std::string line = fmt::format("{}\t{:.6f}", i + 1, 1e-9 * since_first_ns);
    // OpenSim drops an empty last field and then refuses the row; "nan" it reads as missing, and
    // writes itself.
    const BodyPoints missing = BodyPoints::Constant(std::numeric_limits<double>::quiet_NaN());
    const BodyPoints points_Y = IsTracked(row) ? BodyPoints(R_YW * row.points_W) : missing;
    for (const double mm : points_Y.reshaped()) line += '\t' + FixedText(mm, 3);
    out << line << '\n';
  }
}

}  // namespace mocap
