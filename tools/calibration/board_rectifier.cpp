#include "tools/calibration/board_rectifier.h"

#include <algorithm>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace mocap {
namespace {

constexpr double kSmallestShare = 0.002, kLargestShare = 0.7;
constexpr double kRegularEnough_px = 0.25;  // Lens distortion bends a straight grid by this much.
constexpr float kSameQuad_px = 1.5f;
constexpr double kLeastContrast = 40;
constexpr int kSquare_px = 40, kMargin_px = 60;

using Quad = std::vector<cv::Point2f>;

std::optional<Quad> FourCorners(const std::vector<cv::Point>& contour, double picture_area) {
  std::vector<cv::Point> hull;
  cv::convexHull(contour, hull);
  const double area = cv::contourArea(hull);
  if (area < kSmallestShare * picture_area || area > kLargestShare * picture_area)
    return std::nullopt;
  for (const double tolerance : {0.02, 0.035, 0.05}) {
    std::vector<cv::Point> corners;
    cv::approxPolyDP(hull, corners, tolerance * cv::arcLength(hull, true), true);
    if (corners.size() == 4) return Quad(corners.begin(), corners.end());
  }
  return std::nullopt;
}

// Neighbouring threshold levels find the same sheet repeatedly.
bool SameQuad(const Quad& a, const Quad& b) { return cv::norm(a, b, cv::NORM_INF) < kSameQuad_px; }

std::vector<Quad> FindQuads(const cv::Mat& gray) {
  std::vector<Quad> quads;
  for (int level = 60; level < 250; level += 15) {
    cv::Mat bright;
    cv::threshold(gray, bright, level, 255, cv::THRESH_BINARY);
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(bright, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
    for (const auto& contour : contours) {
      const auto quad = FourCorners(contour, static_cast<double>(gray.total()));
      if (quad && std::none_of(quads.begin(), quads.end(),
                               [&](const Quad& known) { return SameQuad(known, *quad); }))
        quads.push_back(*quad);
    }
  }
  return quads;
}

// Deviation of corners from a regular grid in perspective.
double Irregularity(const std::vector<cv::Point2f>& corners, const cv::Size& size) {
  std::vector<cv::Point2f> grid;
  for (int j = 0; j < size.height; ++j)
    for (int i = 0; i < size.width; ++i)
      grid.emplace_back(static_cast<float>(i), static_cast<float>(j));
  const cv::Mat H = cv::findHomography(grid, corners);
  if (H.empty()) return std::numeric_limits<double>::infinity();
  std::vector<cv::Point2f> fitted;
  cv::perspectiveTransform(grid, fitted, H);
  return cv::norm(fitted, corners, cv::NORM_L2) / std::sqrt(static_cast<double>(corners.size()));
}

// Half of a board is dark. Lamps, walls and floors are not; searching them is as costly.
bool HalfDark(const cv::Mat& above) {
  const cv::Rect inside(kMargin_px, kMargin_px, above.cols - 2 * kMargin_px,
                        above.rows - 2 * kMargin_px);
  double low = 0, high = 0;
  cv::minMaxLoc(above(inside), &low, &high);
  if (high - low < kLeastContrast) return false;
  const double dark = static_cast<double>(cv::countNonZero(above(inside) < (low + high) / 2)) /
                      static_cast<double>(inside.area());
  return dark > 0.15 && dark < 0.85;
}

std::vector<cv::Point2f> FindIn(const cv::Mat& gray, const Quad& quad, const cv::Size& size) {
  const float width = static_cast<float>((size.width + 1) * kSquare_px);
  const float height = static_cast<float>((size.height + 1) * kSquare_px);
  const float m = kMargin_px;
  Quad sheet = {{m, m}, {m + width, m}, {m + width, m + height}, {m, m + height}};
  // Contours have either orientation; the picture must not be mirrored.
  if (cv::contourArea(quad, true) < 0) std::reverse(sheet.begin(), sheet.end());
  const cv::Mat H = cv::getPerspectiveTransform(quad, sheet);
  cv::Mat above;
  cv::warpPerspective(gray, above, H, cv::Size(cvRound(width + 2 * m), cvRound(height + 2 * m)),
                      cv::INTER_CUBIC);
  if (!HalfDark(above)) return {};
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCornersSB(
          above, size, corners,
          cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_ACCURACY | cv::CALIB_CB_NORMALIZE_IMAGE))
    return {};
  cv::perspectiveTransform(corners, corners, H.inv());
  return corners;
}

}  // namespace

std::vector<cv::Point2f> FindRectifiedChessboard(const cv::Mat& gray, const cv::Size& size) {
  std::vector<cv::Point2f> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Quad& quad : FindQuads(gray)) {
    for (int turn = 0; turn < 2 && least > kRegularEnough_px; ++turn) {
      Quad turned = quad;
      std::rotate(turned.begin(), turned.begin() + turn, turned.end());
      const std::vector<cv::Point2f> corners = FindIn(gray, turned, size);
      if (corners.empty()) continue;
      const double irregularity = Irregularity(corners, size);
      if (irregularity >= least) continue;
      least = irregularity;
      best = corners;
    }
  }
  return best;
}

}  // namespace mocap
