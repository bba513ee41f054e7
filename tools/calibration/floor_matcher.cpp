#include "tools/calibration/floor_matcher.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/errors.h"

namespace mocap {
namespace {

constexpr int kSide = 300;  // Cells; the board takes a tenth of them.
constexpr double kBoardShare = 0.12;
constexpr double kSteepest = 0.75;  // Lens models are not trusted farther from the axis.
constexpr float kMostContrast = 30;

/// Local contrast of the floor's brightness, and where the floor was visible.
struct TopView {
  cv::Mat detail, seen;
};

TopView Turned(const TopView& view) {
  TopView turned;
  cv::rotate(view.detail, turned.detail, cv::ROTATE_180);
  cv::rotate(view.seen, turned.seen, cv::ROTATE_180);
  return turned;
}

TopView SeeFromAbove(const FloorView& view, const Board& board) {
  const Image<Bgr>& picture = *view.picture;
  const cv::Mat color(picture.height(), picture.width(), CV_8UC3, const_cast<Bgr*>(picture.row(0)));
  cv::Mat gray;
  cv::cvtColor(color, gray, cv::COLOR_BGR2GRAY);
  const double width_mm = (board.columns - 1) * board.square_mm;
  const double height_mm = (board.rows - 1) * board.square_mm;
  const double cell_mm = width_mm / (kBoardShare * kSide);
  TopView top{cv::Mat::zeros(kSide, kSide, CV_32F), cv::Mat::zeros(kSide, kSide, CV_32F)};
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const double x = (i + 0.5 - kSide / 2.0) * cell_mm, y = (j + 0.5 - kSide / 2.0) * cell_mm;
      // The board itself looks the same either way.
      if (std::abs(x) < 0.5 * width_mm + 2 * board.square_mm &&
          std::abs(y) < 0.5 * height_mm + 2 * board.square_mm)
        continue;
      const Vector3 p_C = view.X_CB * Vector3(x + width_mm / 2, y + height_mm / 2, 0);
      if (p_C.z() < 2 * width_mm / 4) continue;
      const Vector2 n = p_C.head<2>() / p_C.z();
      if (n.cwiseAbs().maxCoeff() > kSteepest) continue;
      const auto pixel = PixelFromNormalized(*view.lens, n);
      if (!pixel) continue;
      const int u = static_cast<int>(std::lround(pixel->x()));
      const int v = static_cast<int>(std::lround(pixel->y()));
      if (u < 0 || v < 0 || u >= gray.cols || v >= gray.rows) continue;
      top.detail.at<float>(j, i) = gray.at<std::uint8_t>(v, u);
      top.seen.at<float>(j, i) = 1;
    }
  }
  const cv::Size surroundings(kSide / 5 | 1, kSide / 5 | 1);
  cv::Mat mean, weight;
  cv::blur(top.detail, mean, surroundings);
  cv::blur(top.seen, weight, surroundings);
  cv::Mat local = mean / cv::max(weight, 1e-3);
  cv::Mat deviation = (top.detail - local).mul(top.seen);
  cv::GaussianBlur(deviation, deviation, {}, 2);
  top.detail = deviation.mul(top.seen);
  return top;
}

double Correlation(const TopView& a, const TopView& b) {
  const cv::Mat both = a.seen.mul(b.seen);
  const double count = cv::sum(both)[0];
  if (count < 0.01 * kSide * kSide) return 0;
  const auto prepared = [&](const cv::Mat& detail) {
    cv::Mat m = detail - cv::sum(detail.mul(both))[0] / count;
    m = cv::max(cv::min(m, kMostContrast), -kMostContrast);
    return cv::Mat(m.mul(both));
  };
  const cv::Mat x = prepared(a.detail), y = prepared(b.detail);
  const double norm = cv::norm(x) * cv::norm(y);
  return norm > 0 ? x.dot(y) / norm : 0;
}

}  // namespace

FloorTurns MatchFloors(const std::vector<FloorView>& views, const Board& board) {
  const std::size_t n = views.size();
  MOCAP_CHECK(n >= 1 && n <= 16);
  std::vector<TopView> straight, turned;
  for (const FloorView& view : views) {
    straight.push_back(SeeFromAbove(view, board));
    turned.push_back(Turned(straight.back()));
  }
  cv::Mat same(static_cast<int>(n), static_cast<int>(n), CV_64F), other = same.clone();
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) {
      same.at<double>(static_cast<int>(a), static_cast<int>(b)) =
          Correlation(straight[a], straight[b]);
      other.at<double>(static_cast<int>(a), static_cast<int>(b)) =
          Correlation(straight[a], turned[b]);
    }
  }
  FloorTurns best;
  best.agreement = best.runner_up = -1;
  const double pairs = std::max(1.0, static_cast<double>(n * (n - 1)) / 2);
  // The first camera's turn is arbitrary.
  for (unsigned way = 0; way < 1u << (n - 1); ++way) {
    std::vector<bool> turns(n, false);
    for (std::size_t i = 1; i < n; ++i) turns[i] = way >> (i - 1) & 1;
    double agreement = 0;
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = a + 1; b < n; ++b)
        agreement += (turns[a] == turns[b] ? same : other)
                         .at<double>(static_cast<int>(a), static_cast<int>(b)) /
                     pairs;
    }
    if (agreement > best.agreement) {
      best.runner_up = best.agreement;
      best.agreement = agreement;
      best.turned = turns;
    } else {
      best.runner_up = std::max(best.runner_up, agreement);
    }
  }
  return best;
}

}  // namespace mocap
