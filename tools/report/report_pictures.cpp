#include "tools/report/report_pictures.h"

#include <fmt/format.h>
#include <glib.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <opencv2/core.hpp>

#include "drivers/pixels/jpeg_encoder.h"
#include "tools/page/picture_lines.h"
#include "tools/report/body_outline.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

constexpr int kReportJpegQuality = 80;

using Lines = std::vector<std::vector<Vector2>>;

cv::Rect BoxAround(const std::vector<Vector2>& pixels, const cv::Rect& picture) {
  cv::Rect box;
  for (const Vector2& p : pixels) {
    const cv::Point pixel(static_cast<int>(std::clamp(p.x(), -1e4, 1e4)),
                          static_cast<int>(std::clamp(p.y(), -1e4, 1e4)));
    if (picture.contains(pixel)) box |= cv::Rect(pixel, cv::Size(1, 1));
  }
  return box;
}

/// The bodies and the foreground around them, or else the whole foreground, with a margin; upright
/// 3 : 4 if the picture allows it.
cv::Rect CropAround(const std::vector<BodyLine>& bodies, const Lines& silhouette,
                    const cv::Rect& picture) {
  cv::Rect body;
  for (const BodyLine& line : bodies) body |= BoxAround(line.pixels, picture);
  cv::Rect box = body;
  for (const std::vector<Vector2>& line : silhouette) {
    const cv::Rect around = BoxAround(line, picture);
    if (body.empty() || !(around & body).empty()) box |= around;
  }
  if (box.empty()) box = picture;
  const int height = std::max({160, box.height * 6 / 5, box.width * 8 / 5});
  const cv::Size size(std::min(picture.width, height * 3 / 4), std::min(picture.height, height));
  const cv::Point center = (box.tl() + box.br()) / 2;
  return {cv::Point(std::clamp(center.x - size.width / 2, 0, picture.width - size.width),
                    std::clamp(center.y - size.height / 2, 0, picture.height - size.height)),
          size};
}

/// A line in a crop, to a tenth of a pixel.
Json LineJson(const std::vector<Vector2>& pixels, const cv::Rect& crop) {
  Json points = Json::array();
  for (const Vector2& p : pixels) {
    points.push_back(std::round(10 * (p.x() - crop.x)) / 10);
    points.push_back(std::round(10 * (p.y() - crop.y)) / 10);
  }
  return {{"points", std::move(points)}};
}

Json LinesJson(const Lines& lines, const cv::Rect& crop) {
  Json json = Json::array();
  for (const std::vector<Vector2>& line : lines) json.push_back(LineJson(line, crop));
  return json;
}

std::string JpegUrl(const Image<Bgr>& image, const cv::Rect& crop) {
  std::vector<std::uint8_t> jpeg;
  JpegEncoder().Encode(image.view().Section(crop.x, crop.y, crop.width, crop.height),
                       kReportJpegQuality, jpeg);
  const std::unique_ptr<char, decltype(&g_free)> base64(g_base64_encode(jpeg.data(), jpeg.size()),
                                                        &g_free);
  return std::string("data:image/jpeg;base64,") + base64.get();
}

/// Outlines of the parts, bones and points of a body.
std::vector<BodyLine> LinesOf(const ViewedBody& body, const CameraCalibration& camera,
                              const RigidTransform& X_CW) {
  std::vector<BodyLine> lines = PartOutlines(body.row, body.sizes, camera, X_CW);
  for (BodyLine& bone : StickFigure(body.row, camera, X_CW)) lines.push_back(std::move(bone));
  for (int i = 0; i < kPointCount; ++i) {
    const auto pixel = ProjectPoint(camera, X_CW, body.row.points_W.col(i));
    if (pixel) lines.push_back({BodySide::kMiddle, {*pixel, *pixel}});
  }
  return lines;
}

/// A camera's picture, cropped to the people.
Json PictureJson(const std::string& name, const CameraCalibration& camera, const SampledView& view,
                 std::span<const ViewedBody> bodies) {
  std::vector<BodyLine> all;
  std::vector<int> figures;
  for (const ViewedBody& body : bodies) {
    if (!IsTracked(body.row)) continue;
    for (BodyLine& line : LinesOf(body, camera, view.X_CW)) all.push_back(std::move(line));
    figures.resize(all.size(), body.figure);
  }
  const Lines silhouette = SilhouetteLines(view.trimap.person, 1);
  const cv::Rect crop =
      CropAround(all, silhouette, {0, 0, view.image.width(), view.image.height()});
  Json body = Json::array();
  for (std::size_t i = 0; i < all.size(); ++i) {
    Json& line = body.emplace_back(LineJson(all[i].pixels, crop));
    line["side"] = static_cast<int>(all[i].side);
    line["person"] = figures[i] == ViewedBody::kOfSides ? Json() : Json(figures[i]);
  }
  return {{"name", name},
          {"width_px", crop.width},
          {"height_px", crop.height},
          {"jpeg", JpegUrl(view.image, crop)},
          {"silhouette", LinesJson(silhouette, crop)},
          {"unknown", LinesJson(SilhouetteLines(view.trimap.unknown, 1), crop)},
          {"body", std::move(body)}};
}

}  // namespace

Json PictureSection(const TakeSamples& samples, std::span<const CameraOverlap> overlaps,
                    std::int64_t start_ns, const BodiesAt& bodies_at) {
  Json moments = Json::array();
  bool has_sides = false;
  for (std::size_t m = 0; m < samples.moments.size(); ++m) {
    const SampledMoment& moment = samples.moments[m];
    const std::vector<ViewedBody> bodies = bodies_at(moment.timestamp_ns);
    Json pictures = Json::array();
    for (std::size_t c = 0; c < overlaps.size() && !bodies.empty(); ++c) {
      const auto& view = moment.views[c];
      if (!view || view->image.empty()) continue;
      pictures.push_back(PictureJson(
          fmt::format("{} · IoU {:.0f} %", samples.cameras[c].name, 100 * overlaps[c].iou[m]),
          samples.cameras[c], *view, bodies));
    }
    if (pictures.empty()) continue;
    const PoseRow& row = bodies.front().row;
    std::string name = fmt::format("Frame {}, {:.2f} s", row.frame,
                                   1e-9 * static_cast<double>(row.timestamp_ns - start_ns));
    has_sides = bodies.front().figure == ViewedBody::kOfSides;
    if (has_sides)
      name += fmt::format(", {}", kCaptureStateNames[static_cast<std::size_t>(row.state)]);
    moments.push_back({{"name", name}, {"pictures", std::move(pictures)}});
  }
  if (moments.empty())
    return Paragraph("No frame of the take has the time of a frame of the result.");
  Json keys = {{{"name", "person"}, {"text", "person"}},
               {{"name", "unknown"}, {"text", "unknown: clothes like the wall, or a shadow"}}};
  if (has_sides) {
    keys.push_back({{"name", "left"}, {"text", "the person’s left"}});
    keys.push_back({{"name", "right"}, {"text", "right"}});
  }
  return {{"type", "pictures"}, {"moments", std::move(moments)}, {"keys", std::move(keys)}};
}

}  // namespace mocap
