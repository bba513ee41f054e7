#include "tools/results/trc_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <ostream>

#include "drivers/printable_text.h"
#include "tools/results/export_axes.h"
#include "tools/results/fixed_text.h"

namespace mocap {
namespace {

std::string Header(std::span<const TrcSubject> subjects, const std::vector<PoseRow>& rows,
                   const std::string& file_name) {
  const double rate = 1 / FitClock(rows).period_s;
  const std::size_t markers = subjects.size() * kPointCount;
  std::string text = fmt::format(
      "PathFileType\t4\t(X/Y/Z)\t{}\n"
      "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
      "OrigNumFrames\n"
      "{:.6f}\t{:.6f}\t{}\t{}\tmm\t{:.6f}\t1\t{}\n",
      Printable(file_name), rate, rate, rows.size(), markers, rate, rows.size());
  text += "Frame#\tTime";
  for (const TrcSubject& subject : subjects) {
    const std::string prefix = subject.name.empty() ? "" : Printable(subject.name) + ':';
    for (const std::string_view name : kPointNames) text += fmt::format("\t{}{}\t\t", prefix, name);
  }
  text += "\n\t";
  for (std::size_t i = 1; i <= markers; ++i) text += fmt::format("\tX{0}\tY{0}\tZ{0}", i);
  return text + "\n\n";
}

/// The markers of the frame at a time, nan where the person is not tracked then.
BodyPoints MarkersAt(const std::vector<PoseRow>& poses, std::int64_t time_ns) {
  const auto row = std::ranges::lower_bound(poses, time_ns, {}, &PoseRow::timestamp_ns);
  const bool is_there = row != poses.end() && row->timestamp_ns == time_ns && IsTracked(*row);
  if (is_there) return YUpFromWorld() * row->points_W;
  return BodyPoints::Constant(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

void WriteTrc(const Result& result, const std::string& file_name, std::ostream& out) {
  const TrcSubject subject{"", result};
  WriteTrc(std::span(&subject, 1), result.poses, file_name, out);
}

void WriteTrc(std::span<const TrcSubject> subjects, const std::vector<PoseRow>& rows,
              const std::string& file_name, std::ostream& out) {
  out << Header(subjects, rows, file_name);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::int64_t time_ns = rows[i].timestamp_ns;
    const auto since_first_ns = static_cast<double>(time_ns - rows.front().timestamp_ns);
    std::string line = fmt::format("{}\t{:.6f}", i + 1, 1e-9 * since_first_ns);
    // OpenSim drops an empty last field and then refuses the row; "nan" it reads as missing, and
    // writes itself.
    for (const TrcSubject& subject : subjects) {
      const BodyPoints points_Y = MarkersAt(subject.result.poses, time_ns);
      for (const double mm : points_Y.reshaped()) line += '\t' + FixedText(mm, 3);
    }
    out << line << '\n';
  }
}

}  // namespace mocap
