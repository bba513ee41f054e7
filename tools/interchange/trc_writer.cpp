#include "tools/interchange/trc_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <ostream>

#include "drivers/printable_text.h"
#include "tools/results/export_axes.h"
#include "tools/results/fixed_text.h"

namespace mocap {
namespace {

struct TrcMarker {
  std::string_view name;
  Point point;
};

/// Beside the 23 points.
constexpr std::array<TrcMarker, 8> kFurtherMarkers = {{
    {"LHeel", Point::kHeelL},
    {"RHeel", Point::kHeelR},
    {"LToe", Point::kToeL},
    {"RToe", Point::kToeR},
    {"LAJC", Point::kAnkleL},
    {"RAJC", Point::kAnkleR},
    {"LWJC", Point::kWristL},
    {"RWJC", Point::kWristR},
}};
constexpr std::size_t kTrcMarkerCount = kPointCount + kFurtherMarkers.size();

/// Joint centres have the names of marker sets of OpenSim's models.
constexpr std::array<TrcMarker, kTrcMarkerCount> kTrcMarkers = [] {
  std::array<TrcMarker, kTrcMarkerCount> markers;
  for (int i = 0; i < kPointCount; ++i) markers[i] = {kPointNames[i], static_cast<Point>(i)};
  std::ranges::copy(kFurtherMarkers, markers.begin() + kPointCount);
  const auto name = [&](Point point, std::string_view usual) {
    markers[static_cast<int>(point)].name = usual;
  };
  name(Point::kShoulderL, "LSJC");
  name(Point::kShoulderR, "RSJC");
  name(Point::kElbowL, "LEJC");
  name(Point::kElbowR, "REJC");
  name(Point::kHipL, "LHJC");
  name(Point::kHipR, "RHJC");
  name(Point::kKneeL, "LKJC");
  name(Point::kKneeR, "RKJC");
  return markers;
}();

std::string Header(const ExportScene& scene) {
  const double rate = 1 / FitClock(scene.moments).period_s;
  const std::size_t markers = scene.subjects.size() * kTrcMarkerCount;
  std::string text = fmt::format(
      "PathFileType\t4\t(X/Y/Z)\t{}\n"
      "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
      "OrigNumFrames\n"
      "{:.6f}\t{:.6f}\t{}\t{}\tmm\t{:.6f}\t1\t{}\n",
      Printable(scene.file_name), rate, rate, scene.moments.size(), markers, rate,
      scene.moments.size());
  text += "Frame#\tTime";
  for (const ExportSubject& subject : scene.subjects) {
    const std::string prefix = scene.LabelPrefix(subject);
    for (const TrcMarker& marker : kTrcMarkers)
      text += fmt::format("\t{}{}\t\t", prefix, marker.name);
  }
  text += "\n\t";
  for (std::size_t i = 1; i <= markers; ++i) text += fmt::format("\tX{0}\tY{0}\tZ{0}", i);
  return text + "\n\n";
}

/// The markers at a time, y up; nan if the person is not tracked then, or has no such point.
Eigen::Matrix<double, 3, kTrcMarkerCount> MarkersAt(const std::vector<PoseRow>& poses,
                                                    std::int64_t time_ns) {
  Eigen::Matrix<double, 3, kTrcMarkerCount> markers_Y;
  markers_Y.setConstant(std::numeric_limits<double>::quiet_NaN());
  const auto row = std::ranges::lower_bound(poses, time_ns, {}, &PoseRow::timestamp_ns);
  if (row == poses.end() || row->timestamp_ns != time_ns || !IsTracked(*row)) return markers_Y;
  BodyPlaces places_W;
  places_W << row->points_W, row->further_W;
  for (std::size_t i = 0; i < kTrcMarkerCount; ++i) {
    const auto place = static_cast<int>(kTrcMarkers[i].point);
    markers_Y.col(static_cast<Eigen::Index>(i)) = YUpFromWorld() * places_W.col(place);
  }
  return markers_Y;
}

}  // namespace

ExportRemarks WriteTrc(const ExportScene& scene, std::ostream& out) {
  out << Header(scene);
  for (std::size_t i = 0; i < scene.moments.size(); ++i) {
    const std::int64_t time_ns = scene.moments[i].timestamp_ns;
    const auto since_first_ns = static_cast<double>(time_ns - scene.moments.front().timestamp_ns);
    std::string line = fmt::format("{}\t{:.6f}", i + 1, 1e-9 * since_first_ns);
    // OpenSim drops an empty last field and then rejects the row. It reads "nan" as missing, and
    // writes it itself.
    for (const ExportSubject& subject : scene.subjects) {
      const auto markers_Y = MarkersAt(subject.result.poses, time_ns);
      for (const double mm : markers_Y.reshaped()) line += '\t' + FixedText(mm, 3);
    }
    out << line << '\n';
  }
  return {};
}

}  // namespace mocap
