#include "tools/page/picture_lines.h"

#include <opencv2/imgproc.hpp>

namespace mocap {
namespace {

/// Draw no specks, and no more corners than are visible.
constexpr std::size_t kFewestCorners = 3;
constexpr double kTolerance_px = 0.7;

}  // namespace

std::vector<std::vector<Vector2>> SilhouetteLines(const Silhouette& silhouette, int factor) {
  cv::Mat mask(silhouette.height(), silhouette.width(), CV_8U, cv::Scalar(0));
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (silhouette.Test(x, y)) mask.at<std::uint8_t>(y, x) = 255;
    }
  }
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_CCOMP, cv::CHAIN_APPROX_SIMPLE);
  std::vector<std::vector<Vector2>> lines;
  for (const std::vector<cv::Point>& contour : contours) {
    std::vector<cv::Point> simple;
    cv::approxPolyDP(contour, simple, kTolerance_px, true);
    if (simple.size() < kFewestCorners) continue;
    std::vector<Vector2>& line = lines.emplace_back();
    // The centre of a reduced pixel is that of the square it represents.
    const double shift_px = (factor - 1) / 2.0;
    for (const cv::Point& p : simple) {
      line.emplace_back(p.x * factor + shift_px, p.y * factor + shift_px);
    }
  }
  return lines;
}

}  // namespace mocap
