#include "tools/report/calibration_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/calibration/lens_parameters.h"
#include "tools/report/svg_plot.h"

namespace mocap {
namespace {

constexpr double kErrorScale = 40;
constexpr double kMargin_mm = 600;

// A camera with its field of view.
template <typename XOf, typename YOf>
std::string CameraMark(const CameraCalibration& camera, const XOf& x_of, const YOf& y_of) {
  const RigidTransform X_WC = camera.X_CW.Inverse();
  const double half = camera.width_px / 2.0 / FocalPx(camera.lens);
  std::string cone;
  for (const double side : {-half, half}) {
    const Vector3 ray = X_WC.R * Vector3(side, 0, 1);
    const Vector3 end = X_WC.p + ray * (1500 / std::max(1e-6, ray.head<2>().norm()));
    cone += fmt::format(" L{:.1f} {:.1f}", x_of(end.x()), y_of(end.y()));
  }
  return fmt::format(
      "<path class=\"view-cone\" d=\"M{0:.1f} {1:.1f}{2}Z\"/><circle class=\"camera\" "
      "cx=\"{0:.1f}\" "
      "cy=\"{1:.1f}\" r=\"7\"/><text class=\"label\" style=\"font-size:20px\" x=\"{3:.1f}\" "
      "y=\"{4:.1f}\">{5}</text>",
      x_of(X_WC.p.x()), y_of(X_WC.p.y()), cone, x_of(X_WC.p.x()) + 11, y_of(X_WC.p.y()) + 6,
      EscapeHtml(camera.name));
}

}  // namespace

std::string CoverageSvg(const StudioFit& fit, int camera, const std::vector<CornerError>& errors) {
  const DetectionCamera& size = fit.detections.cameras[camera];
  const Coverage& coverage = fit.cameras[camera].coverage;
  std::string svg =
      fmt::format("<svg class=\"cells-of\" viewBox=\"0 0 {} {}\">", size.width_px, size.height_px);
  int most = 1;
  for (const auto& row : coverage.counts) most = std::max(most, *std::max_element(row, row + 6));
  const double w = static_cast<double>(size.width_px) / Coverage::kColumns;
  const double h = static_cast<double>(size.height_px) / Coverage::kRows;
  for (int y = 0; y < Coverage::kRows; ++y) {
    for (int x = 0; x < Coverage::kColumns; ++x) {
      const int count = coverage.counts[y][x];
      if (count == 0) continue;
      svg += fmt::format(
          "<rect class=\"seen\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
          "opacity=\"{:.2f}\"/>",
          x * w, y * h, w, h, 0.08 + 0.35 * std::sqrt(static_cast<double>(count) / most));
    }
  }
  const double line = size.width_px / 500.0;
  for (const CornerError& error : errors) {
    if (fit.detections.detections[error.detection].camera != camera) continue;
    const Vector2 end = error.pixel + kErrorScale * error.error_px;
    if (!end.allFinite()) continue;
    svg += fmt::format(
        "<line class=\"error\" style=\"stroke-width:{:.1f}\" x1=\"{:.0f}\" y1=\"{:.0f}\" "
        "x2=\"{:.0f}\" y2=\"{:.0f}\"/>",
        line, error.pixel.x(), error.pixel.y(), end.x(), end.y());
  }
  return svg +
         fmt::format("<rect class=\"frame\" x=\"1\" y=\"1\" width=\"{}\" height=\"{}\"/></svg>",
                     size.width_px - 2, size.height_px - 2);
}

std::string RoomPlanSvg(const std::vector<CameraCalibration>& cameras, const SeenVolume& volume) {
  Vector2 low = Vector2::Zero(), high = Vector2::Zero();
  for (const CameraCalibration& camera : cameras) {
    const Vector2 p = camera.X_CW.Inverse().p.head<2>();
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  for (int j = 0; j < volume.rows; ++j) {
    for (int i = 0; i < volume.columns; ++i) {
      if (volume.plan[static_cast<std::size_t>(j) * volume.columns + i] < 2) continue;
      const Vector2 p = volume.low_W.head<2>() + volume.cell_mm * Vector2(i, j);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  low.array() -= kMargin_mm;
  high.array() += kMargin_mm;
  const auto x_of = [&](double x) { return (x - low.x()) / 10; };
  const auto y_of = [&](double y) { return (high.y() - y) / 10; };
  std::string svg = fmt::format("<svg class=\"cells-of\" viewBox=\"0 0 {:.0f} {:.0f}\">",
                                (high.x() - low.x()) / 10, (high.y() - low.y()) / 10);
  for (int j = 0; j < volume.rows; ++j) {
    for (int i = 0; i < volume.columns; ++i) {
      const int seen = volume.plan[static_cast<std::size_t>(j) * volume.columns + i];
      if (seen < 2) continue;
      svg += fmt::format(
          "<rect class=\"room\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
          "opacity=\"{:.2f}\"/>",
          x_of(volume.low_W.x() + i * volume.cell_mm),
          y_of(volume.low_W.y() + (j + 1) * volume.cell_mm), volume.cell_mm / 10,
          volume.cell_mm / 10, 0.6 * seen / static_cast<double>(cameras.size()));
    }
  }
  for (double x = std::ceil(low.x() / 1000) * 1000; x < high.x(); x += 1000)
    svg +=
        fmt::format("<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"0\" y2=\"{1:.1f}\"/>",
                    x_of(x), y_of(low.y()));
  for (double y = std::ceil(low.y() / 1000) * 1000; y < high.y(); y += 1000)
    svg +=
        fmt::format("<line class=\"grid\" y1=\"{0:.1f}\" y2=\"{0:.1f}\" x1=\"0\" x2=\"{1:.1f}\"/>",
                    y_of(y), x_of(high.x()));
  // The origin with x and y axes, half a metre each.
  svg += fmt::format(
      "<path class=\"axes\" d=\"M{0:.1f} {3:.1f}V{1:.1f}H{2:.1f}\"/><text style=\"font-size:20px\" "
      "x=\"{4:.1f}\" "
      "y=\"{1:.1f}\">x</text><text style=\"font-size:20px\" x=\"{0:.1f}\" y=\"{5:.1f}\">y</text>",
      x_of(0), y_of(0), x_of(500), y_of(500), x_of(550), y_of(560));
  for (const CameraCalibration& camera : cameras) {
    svg += CameraMark(camera, x_of, y_of);
  }
  return svg + "</svg>";
}

}  // namespace mocap
