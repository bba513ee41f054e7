#include "tools/report/calibration_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drivers/utc_time.h"
#include "tools/report/calibration_figures.h"
#include "tools/report/report_style.h"
#include "tools/report/svg_plot.h"

namespace mocap {
namespace {

constexpr std::size_t kWorstViews = 8;

constexpr const char* kStyle = R"(
.conclusion { font-size: 17px; border-left: 4px solid var(--c2); padding: 2px 0 2px 14px; margin: 14px 0 24px; }
.conclusion.warning { border-color: var(--c3); } .verdict.error { border-color: #d64545; }
.findings { padding: 0; list-style: none; } .findings li { margin: 5px 0 5px 66px; max-width: 86ch; text-indent: -66px; }
.findings b { display: inline-block; width: 66px; font-weight: 600; text-indent: 0; }
.axes { fill: none; stroke: var(--fg); stroke-width: 2; }
.error b { color: #d64545; } .warning b { color: var(--c3); } .note b { color: var(--muted); }
.cells { display: grid; grid-template-columns: repeat(auto-fit, minmax(300px, 1fr)); gap: 12px; }
.cells figure { margin: 0; } svg.cells-of { display: block; width: 100%; height: auto; }
svg.cells-of text { font: 11px system-ui, sans-serif; fill: var(--muted); }
.seen { fill: var(--c0); } .frame { fill: none; stroke: var(--muted); }
.error { stroke: var(--c1); stroke-width: .8; } .room { fill: var(--c2); }
.camera { fill: var(--c1); } .view-cone { fill: var(--c1); opacity: .10; }
svg.cells-of text.label { fill: var(--fg); font-weight: 600; }
)";

// A board at rest need not cover the pictures.
bool WasCarried(const StudioFit& fit) { return fit.bundle.X_WB.size() > 1; }

std::string Tile(const std::string& what, const std::string& value, const std::string& unit,
                 const std::string& under) {
  return fmt::format(
      "<div class=\"tile\"><span>{}</span><b>{}<small>{}</small></b><span>{}</span></div>", what,
      value, unit, under);
}

std::string CalibrationTiles(const StudioFit& fit, const SeenVolume& volume) {
  const Vector3 middle_W = MiddleOfRoom(fit.bundle.cameras);
  double worst_mm = 0;
  std::size_t worst = 0;
  for (std::size_t c = 0; c < fit.cameras.size(); ++c) {
    const double mm = fit.cameras[c].rms_px * MillimetresPerPixel(fit.bundle.cameras[c], middle_W);
    if (mm >= worst_mm) worst = c;
    worst_mm = std::max(worst_mm, mm);
  }
  const std::size_t n = fit.cameras.size();
  std::string tiles = "<div class=\"tiles\">";
  tiles += Tile("Reprojection", fmt::format("{:.2f}", fit.rms_px), " px", "over all cameras");
  tiles += Tile("At the person", fmt::format("{:.1f}", worst_mm), " mm",
                "the worst camera, " + EscapeHtml(fit.cameras[worst].name));
  tiles += Tile("Cameras", std::to_string(n), "",
                fmt::format("{} views of the board", fit.detections.detections.size()));
  if (n >= 3 && fit.has_floor)
    tiles += Tile("Seen by three", fmt::format("{:.0f}", volume.cubic_m[3]), " m³",
                  "up to 2.2 m above the floor");
  if (fit.has_floor)
    tiles += Tile(fmt::format("Seen by all {}", n), fmt::format("{:.0f}", volume.cubic_m[n]), " m³",
                  "up to 2.2 m above the floor");
  return tiles + "</div>\n";
}

std::string FindingList(const std::vector<Finding>& findings) {
  if (findings.empty()) return "<p>No findings.</p>\n";
  std::string html = "<ul class=\"findings\">";
  for (const Finding& finding : findings) {
    const char* name = NameOf(finding.severity);
    html += fmt::format("<li class=\"{0}\"><b>{0}</b>{1}</li>", name, EscapeHtml(finding.text));
  }
  return html + "</ul>\n";
}

std::string CameraTable(const StudioFit& fit) {
  const Vector3 middle_W = MiddleOfRoom(fit.bundle.cameras);
  std::string html =
      "<table><tr><th>camera</th><th class=\"n\">views</th><th class=\"n\">corners</th><th "
      "class=\"n\">lens alone px</th><th class=\"n\">together px</th><th class=\"n\">mm at the "
      "person</th><th class=\"n\">covered</th><th class=\"n\">height mm</th><th>still "
      "missing</th></tr>";
  for (std::size_t c = 0; c < fit.cameras.size(); ++c) {
    const CameraFit& camera = fit.cameras[c];
    const CameraCalibration& calibration = fit.bundle.cameras[c];
    html += fmt::format(
        "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td "
        "class=\"n\">{:.3f}</td><td class=\"n\">{:.2f}</td><td class=\"n\">{:.0f} %</td><td "
        "class=\"n\">{}</td><td>{}</td></tr>",
        EscapeHtml(camera.name), camera.views, camera.corners,
        camera.lens_rms_px > 0 ? fmt::format("{:.3f}", camera.lens_rms_px) : "given", camera.rms_px,
        camera.rms_px * MillimetresPerPixel(calibration, middle_W), 100 * camera.coverage.share,
        fit.has_floor ? fmt::format("{:.0f}", calibration.X_CW.Inverse().p.z()) : "–",
        WasCarried(fit) ? EscapeHtml(camera.coverage.Hint()) : "");
  }
  return html + "</table>\n";
}

std::string VolumeTable(const SeenVolume& volume) {
  std::string html = "<table><tr><th>seen by at least</th><th class=\"n\">m³</th><th></th></tr>";
  for (std::size_t n = 2; n < volume.cubic_m.size(); ++n)
    html += fmt::format(
        "<tr><td>{} cameras</td><td class=\"n\">{:.1f}</td><td class=\"bar\"><i "
        "style=\"width:{:.0f}%\"></i></td></tr>",
        n, volume.cubic_m[n], 100 * volume.cubic_m[n] / std::max(1e-9, volume.cubic_m[2]));
  return html + "</table>\n";
}

std::string WorstViews(const StudioFit& fit, const std::vector<CornerError>& errors) {
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
  std::string html =
      "<table><tr><th>camera</th><th>frame</th><th class=\"n\">px</th><th "
      "class=\"n\">corners</th></tr>";
  for (const View& view : views) {
    const BoardDetection& s = fit.detections.detections[view.detection];
    html += fmt::format(
        "<tr><td>{}</td><td>{}</td><td class=\"n\">{:.2f}</td><td class=\"n\">{}</td></tr>",
        EscapeHtml(fit.cameras[s.camera].name), EscapeHtml(s.name), view.rms(), view.count);
  }
  return html + "</table>\n";
}

}  // namespace

std::string CalibrationReportHtml(const std::string& title, std::int64_t made_s,
                                  const StudioFit& fit, const std::vector<Finding>& findings) {
  const std::vector<CornerError> errors = BundleErrors(fit.detections, fit.bundle);
  const SeenVolume volume = MeasureSeenVolume(fit.bundle.cameras);
  const char* mood = CountOf(Severity::kWrong, findings) > 0     ? "error"
                     : CountOf(Severity::kWarning, findings) > 0 ? "warning"
                                                                 : "good";
  std::string html = fmt::format(
      "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>{0}</title><style>{1}{2}</style><main><h1>{0}</h1>"
      "<p class=\"under\">{7}; {3}; {4}</p>"
      "<p class=\"conclusion {5}\">{6}</p>\n",
      EscapeHtml(title), kReportStyle, kStyle, EscapeHtml(fit.detections.board.Text()),
      fit.has_floor ? "world right-handed, z up, floor at z = 0, millimetres"
                    : "world of the first camera (x right, y down, z forward), millimetres",
      mood, EscapeHtml(Conclusion(findings)), UtcText(made_s));
  html += CalibrationTiles(fit, volume);
  html += "<h2>Findings</h2>\n" + FindingList(findings);
  html += "<h2>Cameras</h2>\n" + CameraTable(fit);
  if (fit.has_floor)
    html +=
        "<h2>The room from above</h2><div class=\"two\"><figure>" +
        RoomPlanSvg(fit.bundle.cameras, volume) +
        "<figcaption>How many cameras see each place at 1 m height: the darker, the more. Grid of "
        "1 m; x to the right, y up.</figcaption></figure><div>" +
        VolumeTable(volume) + "</div></div>\n";
  html += "<h2>Where the board was seen</h2><div class=\"cells\">";
  for (std::size_t c = 0; c < fit.cameras.size(); ++c)
    html += "<figure>" + CoverageSvg(fit, static_cast<int>(c), errors) + "<figcaption><b>" +
            EscapeHtml(fit.cameras[c].name) + "</b> " +
            (WasCarried(fit) ? EscapeHtml(fit.cameras[c].coverage.Hint()) : "") +
            "</figcaption></figure>";
  html +=
      "</div><p class=\"under\">Corners in each part of the picture; lines are errors, magnified "
      "40 times.</p>\n";
  html += "<h2>Worst views</h2>\n" + WorstViews(fit, errors);
  return html + "</main></html>\n";
}

}  // namespace mocap
