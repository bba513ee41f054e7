#include "tools/report/calibration_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drivers/utc_time.h"
#include "tools/report/calibration_figures.h"
#include "tools/report/report_page.h"

namespace mocap {
namespace {

constexpr std::size_t kWorstViews = 8;

// A board at rest need not cover the pictures.
bool WasCarried(const StudioFit& fit) { return fit.bundle.X_WB.size() > 1; }

Json CalibrationTiles(const StudioFit& fit, const SeenVolume& volume) {
  const Vector3 middle_W = MiddleOfRoom(fit.bundle.cameras);
  double worst_mm = 0;
  std::size_t worst = 0;
  for (std::size_t c = 0; c < fit.cameras.size(); ++c) {
    const double mm = fit.cameras[c].rms_px * MillimetresPerPixel(fit.bundle.cameras[c], middle_W);
    if (mm >= worst_mm) worst = c;
    worst_mm = std::max(worst_mm, mm);
  }
  const std::size_t n = fit.cameras.size();
  const auto seen = [&](const std::string& name, std::size_t count) {
    return Tile(name, NumberOrNull(volume.cubic_m[count]), 0, "m³", "up to 2.2 m above the floor");
  };
  Json tiles = {Tile("Reprojection", NumberOrNull(fit.rms_px), 2, "px", "over all cameras"),
                Tile("At the person", NumberOrNull(worst_mm), 1, "mm",
                     "the worst camera, " + fit.cameras[worst].name),
                Tile("Cameras", n, 0, "",
                     fmt::format("{} views of the board", fit.detections.detections.size()))};
  if (n >= 3 && fit.has_floor) tiles.push_back(seen("Seen by three", 3));
  if (fit.has_floor) tiles.push_back(seen(fmt::format("Seen by all {}", n), n));
  return Tiles(tiles);
}

Json FindingSections(const std::vector<Finding>& findings) {
  if (findings.empty()) return Json::array({Paragraph("No findings.")});
  Json rows = Json::array();
  for (const Finding& finding : findings) {
    const char* tone = finding.severity == Severity::kWrong     ? "bad"
                       : finding.severity == Severity::kWarning ? "warn"
                                                                : "";
    rows.push_back({{{"text", NameOf(finding.severity)}, {"tone", tone}}, finding.text});
  }
  return Json::array({Table({{"kind"}, {"finding"}}, rows)});
}

Json CameraTable(const StudioFit& fit) {
  const Vector3 middle_W = MiddleOfRoom(fit.bundle.cameras);
  Json rows = Json::array();
  for (std::size_t c = 0; c < fit.cameras.size(); ++c) {
    const CameraFit& camera = fit.cameras[c];
    const CameraCalibration& calibration = fit.bundle.cameras[c];
    rows.push_back({camera.name, camera.views, camera.corners,
                    camera.lens_rms_px > 0 ? NumberOrNull(camera.lens_rms_px) : Json("given"),
                    NumberOrNull(camera.rms_px),
                    NumberOrNull(camera.rms_px * MillimetresPerPixel(calibration, middle_W)),
                    NumberOrNull(100 * camera.coverage.share),
                    fit.has_floor ? NumberOrNull(calibration.X_CW.Inverse().p.z()) : Json(),
                    WasCarried(fit) ? camera.coverage.Hint() : ""});
  }
  return Table({{"camera"},
                {"views", 0},
                {"corners", 0},
                {"lens alone px", 3},
                {"together px", 3},
                {"mm at the person", 2},
                {"covered %", 0},
                {"height mm", 0},
                {"still missing"}},
               rows);
}

Json VolumeTable(const SeenVolume& volume) {
  Json seen = Json::object();
  for (std::size_t n = 2; n < volume.cubic_m.size(); ++n)
    seen[fmt::format("{} cameras", n)] = NumberOrNull(volume.cubic_m[n]);
  return BarTable("seen by at least", "m³", 1, seen);
}

Json WorstViews(const StudioFit& fit, const std::vector<CornerError>& errors) {
  struct View {
    int detection;
    double sum = 0;
    int count = 0;
    double rms() const { return std::sqrt(sum / std::max(1, count)); }
  };
  std::vector<View> views;
  for (std::size_t s = 0; s < fit.detections.detections.size(); ++s)
    views.push_back({static_cast<int>(s)});
  for (const CornerError& error : errors) {
    views[error.detection].sum += error.error_px.squaredNorm();
    ++views[error.detection].count;
  }
  std::sort(views.begin(), views.end(),
            [](const View& a, const View& b) { return a.rms() > b.rms(); });
  views.resize(std::min(views.size(), kWorstViews));
  Json rows = Json::array();
  for (const View& view : views) {
    const BoardDetection& s = fit.detections.detections[view.detection];
    rows.push_back({fit.cameras[s.camera].name, s.name, NumberOrNull(view.rms()), view.count});
  }
  return Table({{"camera"}, {"frame"}, {"px", 2}, {"corners", 0}}, rows);
}

}  // namespace

std::string CalibrationReportHtml(const std::string& title, std::int64_t made_s,
                                  const StudioFit& fit, const std::vector<Finding>& findings) {
  const std::vector<CornerError> errors = BundleErrors(fit.detections, fit.bundle);
  const SeenVolume volume = MeasureSeenVolume(fit.bundle.cameras);
  const char* tone = CountOf(Severity::kWrong, findings) > 0     ? "bad"
                     : CountOf(Severity::kWarning, findings) > 0 ? "warn"
                                                                 : "ok";
  Json sections = {Paragraph(Conclusion(findings), tone), CalibrationTiles(fit, volume),
                   Heading("Findings")};
  Append(FindingSections(findings), sections);
  sections.push_back(Heading("Cameras"));
  sections.push_back(CameraTable(fit));
  if (fit.has_floor) {
    sections.push_back(Heading("The room from above"));
    sections.push_back(Beside(
        {Json::array({RoomPlan(fit.bundle.cameras, volume)}), Json::array({VolumeTable(volume)})}));
  }
  Json coverage = Json::array();
  for (std::size_t c = 0; c < fit.cameras.size(); ++c) {
    coverage.push_back(Json::array({CoverageFigure(
        fit, static_cast<int>(c), errors, WasCarried(fit) ? fit.cameras[c].coverage.Hint() : "")}));
  }
  sections.push_back(Heading("Where the board was seen"));
  sections.push_back(Beside(coverage));
  sections.push_back(
      Paragraph("Corners in each part of the picture; lines are errors, magnified 40 times."));
  sections.push_back(Heading("Worst views"));
  sections.push_back(WorstViews(fit, errors));
  return ReportHtml(
      title,
      fmt::format("{}; {}; {}", fit.detections.board.Text(),
                  fit.has_floor ? "world right-handed, z up, floor at z = 0, millimetres"
                                : "world of the first camera (x right, y down, z forward), "
                                  "millimetres",
                  UtcText(made_s)),
      sections);
}

}  // namespace mocap
