#include "tools/report/report_views.h"

#include <fmt/format.h>
#include <turbojpeg.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <span>

#include "core/errors.h"
#include "tools/report/body_outline.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

constexpr const char* kSideClasses[] = {"middle", "left", "right"};

std::string Base64(std::span<const unsigned char> bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

cv::Mat MaskOf(const Silhouette& silhouette) {
  cv::Mat mask(silhouette.height(), silhouette.width(), CV_8U, cv::Scalar(0));
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (silhouette.Test(x, y)) mask.at<std::uint8_t>(y, x) = 255;
    }
  }
  return mask;
}

using Contours = std::vector<std::vector<cv::Point>>;

/// Borders, with those of holes.
Contours ContoursOf(const Silhouette& silhouette) {
  Contours contours;
  cv::findContours(MaskOf(silhouette), contours, cv::RETR_CCOMP, cv::CHAIN_APPROX_SIMPLE);
  return contours;
}

/// Region of interest: the body and the foreground around it. Without a tracked body, the whole
/// foreground.
cv::Rect BoxOf(const std::vector<BodyLine>& body, const Contours& contours, const cv::Size& size) {
  const cv::Rect picture(cv::Point(), size);
  cv::Rect body_box;
  for (const BodyLine& line : body) {
    for (const Vector2& p : line.pixels) {
      const cv::Point pixel(static_cast<int>(std::clamp(p.x(), -1e4, 1e4)),
                            static_cast<int>(std::clamp(p.y(), -1e4, 1e4)));
      if (picture.contains(pixel)) body_box |= cv::Rect(pixel, cv::Size(1, 1));
    }
  }
  cv::Rect box = body_box;
  for (const std::vector<cv::Point>& contour : contours) {
    const cv::Rect contour_box = cv::boundingRect(contour);
    if (body_box.empty() || !(contour_box & body_box).empty()) box |= contour_box;
  }
  return box.empty() ? picture : box;
}

/// The box with a margin, upright 3 : 4 if the picture allows it.
cv::Rect CropAround(const cv::Rect& box, const cv::Size& picture) {
  const int height = std::max({160, box.height * 6 / 5, box.width * 8 / 5});
  const cv::Size size(std::min(picture.width, height * 3 / 4), std::min(picture.height, height));
  const cv::Point center = (box.tl() + box.br()) / 2;
  return {cv::Point(std::clamp(center.x - size.width / 2, 0, picture.width - size.width),
                    std::clamp(center.y - size.height / 2, 0, picture.height - size.height)),
          size};
}

std::string JpegOf(const Image<Bgr>& image, const cv::Rect& crop) {
  constexpr int kQuality = 80;
  const std::unique_ptr<void, decltype(&tjDestroy)> encoder(tjInitCompress(), tjDestroy);
  MOCAP_CHECK(encoder);
  const auto* pixels = reinterpret_cast<const unsigned char*>(image.row(crop.y) + crop.x);
  const int row_bytes = image.width() * static_cast<int>(sizeof(Bgr));
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const int failed = tjCompress2(encoder.get(), pixels, crop.width, row_bytes, crop.height,
                                 TJPF_BGR, &bytes, &size, TJSAMP_420, kQuality, 0);
  const std::unique_ptr<unsigned char, decltype(&tjFree)> jpeg(bytes, tjFree);
  MOCAP_CHECK(failed == 0);
  return Base64({bytes, size});
}

std::string PathOf(const std::vector<Vector2>& pixels, bool closed) {
  std::string path;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? 'M' : 'L', pixels[i].x(), pixels[i].y());
  }
  return path + (closed ? "Z" : "");
}

std::string ContourPath(const Contours& contours) {
  std::string path;
  for (const std::vector<cv::Point>& contour : contours) {
    std::vector<cv::Point> simple;
    cv::approxPolyDP(contour, simple, 0.7, true);
    std::vector<Vector2> pixels;
    for (const cv::Point& p : simple) pixels.emplace_back(p.x, p.y);
    path += PathOf(pixels, true);
  }
  return path;
}

std::string PointDots(const PoseRow& row, const CameraCalibration& camera,
                      const RigidTransform& X_CW) {
  std::string svg;
  for (int i = 0; i < kPointCount; ++i) {
    const auto pixel = ProjectPoint(camera, X_CW, row.points_W.col(i));
    if (!pixel) continue;
    svg += fmt::format("<circle class=\"point\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>", pixel->x(),
                       pixel->y(), i < kBodyPartCount ? 1 : 1.7);
  }
  return svg;
}

std::string ClassOf(const ViewedBody& body, BodySide side) {
  if (body.color == ViewedBody::kOfSides) return kSideClasses[static_cast<int>(side)];
  return fmt::format("c{}", body.color);
}

std::string BodySvg(const ViewedBody& body, const std::vector<BodyLine>& parts,
                    const CameraCalibration& camera, const RigidTransform& X_CW) {
  std::string svg;
  for (const BodyLine& part : parts) {
    svg += fmt::format("<path class=\"part {}\" d=\"{}\"/>", ClassOf(body, part.side),
                       PathOf(part.pixels, true));
  }
  for (const BodyLine& stick : StickFigure(body.row, camera, X_CW)) {
    svg += fmt::format("<path class=\"stick {}\" d=\"{}\"/>", ClassOf(body, stick.side),
                       PathOf(stick.pixels, false));
  }
  return svg + PointDots(body.row, camera, X_CW);
}

}  // namespace

std::string CameraViewSvg(const CameraCalibration& camera, const SampledView& view,
                          std::span<const ViewedBody> bodies) {
  std::vector<BodyLine> outlines;
  std::string drawn;
  for (const ViewedBody& body : bodies) {
    if (!IsTracked(body.row)) continue;
    const std::vector<BodyLine> parts = PartOutlines(body.row, body.sizes, camera, view.X_CW);
    outlines.insert(outlines.end(), parts.begin(), parts.end());
    drawn += BodySvg(body, parts, camera, view.X_CW);
  }
  const Contours contours = ContoursOf(view.trimap.person);
  const cv::Size size(view.image.width(), view.image.height());
  const cv::Rect crop = CropAround(BoxOf(outlines, contours, size), size);
  // SVG coordinates start at a pixel's corner, the camera's at its centre.
  return fmt::format(
      "<svg class=\"view\" viewBox=\"{0} {1} {2} {3}\"><image x=\"{0}\" y=\"{1}\" width=\"{2}\" "
      "height=\"{3}\" href=\"data:image/jpeg;base64,{4}\"/><g transform=\"translate(.5 .5)\">"
      "<path class=\"unknown\" d=\"{5}\"/><path class=\"silhouette\" d=\"{6}\"/>{7}</g></svg>",
      crop.x, crop.y, crop.width, crop.height, JpegOf(view.image, crop),
      ContourPath(ContoursOf(view.trimap.unknown)), ContourPath(contours), drawn);
}

std::string TrimapKey() {
  return "<svg width=\"0\" height=\"0\" aria-hidden=\"true\"><defs><pattern id=\"hatch\" "
         "width=\"5\" height=\"5\" patternUnits=\"userSpaceOnUse\" "
         "patternTransform=\"rotate(45)\"><rect class=\"hatch\" width=\"1.5\" height=\"5\"/>"
         "</pattern></defs></svg><span><i class=\"silhouette\"></i>person</span><span><i "
         "class=\"unknown\"></i>unknown: clothes like the wall, or a shadow</span>";
}

}  // namespace mocap
