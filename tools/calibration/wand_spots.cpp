#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "tools/calibration/wand.h"

namespace mocap {
namespace {

constexpr double kBrightShare = 0.6;
constexpr int kLeastSpotContrast = 60;
constexpr int kFewestPixels = 3;
constexpr double kLargestSpotShare = 0.003;
constexpr std::size_t kMostSpots = 12;
/// A spot within this distance in this share of the frames is a lamp.
constexpr double kSamePlace_px = 4;
constexpr double kLampShare = 0.3;
constexpr std::size_t kLampSamples = 100;

cv::Mat BrightPart(const cv::Mat& gray, int& level) {
  double brightest = 0;
  cv::minMaxLoc(gray, nullptr, &brightest);
  const double mean = cv::mean(gray)[0];
  level = static_cast<int>(mean + kBrightShare * (brightest - mean));
  if (brightest - mean < kLeastSpotContrast) return {};
  return gray > level;
}

bool IsCompact(const cv::Mat& stats, int label, double picture_area) {
  const int width = stats.at<int>(label, cv::CC_STAT_WIDTH);
  const int height = stats.at<int>(label, cv::CC_STAT_HEIGHT);
  const int area = stats.at<int>(label, cv::CC_STAT_AREA);
  return area >= kFewestPixels && area <= kLargestSpotShare * picture_area &&
         2 * area >= width * height && width <= 3 * height && height <= 3 * width;
}

// Centroid of the light within a box, weighted by its brightness above the surroundings.
Vector2 MiddleOfLight(const cv::Mat& gray, const cv::Rect& box, int level) {
  const cv::Rect around =
      cv::Rect(box.x - 2, box.y - 2, box.width + 4, box.height + 4) & cv::Rect({}, gray.size());
  Vector2 sum = Vector2::Zero();
  double weight = 0;
  for (int y = around.y; y < around.y + around.height; ++y) {
    for (int x = around.x; x < around.x + around.width; ++x) {
      const double light = std::max(0, gray.at<std::uint8_t>(y, x) - level / 2);
      sum += light * Vector2(x, y);
      weight += light;
    }
  }
  return sum / weight;
}

double Apart(const BoardCorners& a, const BoardCorners& b) {
  return (a.pixels[0] - b.pixels[0]).norm() + (a.pixels[1] - b.pixels[1]).norm();
}

}  // namespace

std::vector<Vector2> FindSpots(ImageView<const Bgr> image) {
  const cv::Mat view(image.height(), image.width(), CV_8UC3, const_cast<Bgr*>(image.row(0)),
                     image.stride() * sizeof(Bgr));
  cv::Mat gray;
  cv::cvtColor(view, gray, cv::COLOR_BGR2GRAY);
  int level = 0;
  const cv::Mat bright = BrightPart(gray, level);
  std::vector<Vector2> spots;
  if (bright.empty()) return spots;
  cv::Mat labels, stats, middles;
  const int count = cv::connectedComponentsWithStats(bright, labels, stats, middles);
  for (int label = 1; label < count && spots.size() < kMostSpots; ++label) {
    if (!IsCompact(stats, label, static_cast<double>(gray.total()))) continue;
    const cv::Rect box(
        stats.at<int>(label, cv::CC_STAT_LEFT), stats.at<int>(label, cv::CC_STAT_TOP),
        stats.at<int>(label, cv::CC_STAT_WIDTH), stats.at<int>(label, cv::CC_STAT_HEIGHT));
    spots.push_back(MiddleOfLight(gray, box, level));
  }
  return spots;
}

void KeepWands(std::vector<BoardDetection>& of_camera) {
  const std::vector<BoardDetection> all = of_camera;
  const std::size_t step = std::max<std::size_t>(1, all.size() / kLampSamples);
  const auto is_lamp = [&](const Vector2& spot) {
    int frames = 0, lit = 0;
    for (std::size_t i = 0; i < all.size(); i += step, ++frames) {
      lit += std::ranges::any_of(all[i].corners.pixels, [&](const Vector2& other) {
        return (other - spot).norm() < kSamePlace_px;
      });
    }
    return lit > std::max(2.0, kLampShare * frames);
  };
  for (BoardDetection& s : of_camera) {
    std::erase_if(s.corners.pixels, is_lamp);
    s.corners.ids = {0, 1};
  }
  std::erase_if(of_camera, [](const BoardDetection& s) { return s.corners.pixels.size() != 2; });
  for (std::size_t i = 1; i < of_camera.size(); ++i) {
    BoardCorners turned = of_camera[i].corners;
    std::swap(turned.pixels[0], turned.pixels[1]);
    const BoardCorners& before = of_camera[i - 1].corners;
    if (Apart(turned, before) < Apart(of_camera[i].corners, before)) of_camera[i].corners = turned;
  }
}

}  // namespace mocap
