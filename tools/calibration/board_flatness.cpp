#include "tools/calibration/board_flatness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "core/errors.h"

namespace mocap {
namespace {

constexpr std::size_t kFewestNeighbours = 6;
constexpr int kFewestComparedCorners = 4;
constexpr double kWidestSteps = 0.1;                        // Of the picture's width.
constexpr double kMostUneven_px = 1.5, kMostUneven = 0.05;  // Sharp corners are far better.

struct Neighbourhood {
  std::vector<cv::Point2d> places_mm, pixels;
};

Neighbourhood NeighboursOf(const Board& board, const BoardCorners& corners, std::size_t middle) {
  Neighbourhood around;
  const int id = corners.ids[middle];
  for (std::size_t i = 0; i < corners.ids.size(); ++i) {
    const int across = std::abs(corners.ids[i] % board.columns - id % board.columns);
    const int down = std::abs(corners.ids[i] / board.columns - id / board.columns);
    if (across > 1 || down > 1 || across + down == 0) continue;
    const Vector3 p_B = board.Corner(corners.ids[i]);
    around.places_mm.emplace_back(p_B.x(), p_B.y());
    around.pixels.emplace_back(corners.pixels[i].x(), corners.pixels[i].y());
  }
  return around;
}

}  // namespace

std::optional<Unevenness> UnevennessOf(const Board& board, const BoardCorners& corners,
                                       int width_px) {
  double squares = 0, step_squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < corners.ids.size(); ++i) {
    const Neighbourhood around = NeighboursOf(board, corners, i);
    if (around.pixels.size() < kFewestNeighbours) continue;
    const cv::Mat H = cv::findHomography(around.places_mm, around.pixels);
    if (H.empty()) continue;
    const Vector3 p_B = board.Corner(corners.ids[i]);
    const std::vector<cv::Point2d> place = {{p_B.x(), p_B.y()}};
    std::vector<cv::Point2d> expected;
    cv::perspectiveTransform(place, expected, H);
    const cv::Point2d pixel(corners.pixels[i].x(), corners.pixels[i].y());
    for (const cv::Point2d& neighbour : around.pixels)
      step_squares +=
          std::pow(cv::norm(neighbour - pixel), 2) / static_cast<double>(around.pixels.size());
    squares += std::pow(cv::norm(expected[0] - pixel), 2);
    ++count;
  }
  if (count < kFewestComparedCorners) return std::nullopt;
  const double step_px = std::sqrt(step_squares / count);
  if (step_px > kWidestSteps * width_px) return std::nullopt;
  const double rms_px = std::sqrt(squares / count);
  return Unevenness{rms_px, rms_px / step_px};
}

void RefuseUneven(const std::string& where, const BoardDetections& detections, std::size_t first) {
  int flat = 0, uneven = 0;
  const BoardDetection* worst = nullptr;
  double worst_px = 0;
  for (std::size_t s = first; s < detections.detections.size(); ++s) {
    const BoardDetection& view = detections.detections[s];
    const auto found =
        UnevennessOf(detections.board, view.corners, detections.cameras[view.camera].width_px);
    if (!found) continue;
    const bool is_uneven = found->rms_px > kMostUneven_px && found->share > kMostUneven;
    ++(is_uneven ? uneven : flat);
    if (!is_uneven || found->rms_px <= worst_px) continue;
    worst = &view;
    worst_px = found->rms_px;
  }
  if (uneven <= flat) return;
  throw SetupError(fmt::format(
      "{}: in {} of {} views the corners lie on no plane ({:.1f} px off in {}, though they are "
      "sharp): the board is not a {}, or is not flat; measure it and compare it with --board",
      where, uneven, uneven + flat, worst_px, worst->name, detections.board.Text()));
}

}  // namespace mocap
