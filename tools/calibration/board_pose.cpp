#include "tools/calibration/board_pose.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

namespace mocap {
namespace {

RigidTransform FromOpenCv(const cv::Mat& rotation_vector, const cv::Mat& translation) {
  const auto vector = [](const cv::Mat& m) {
    return Vector3(m.at<double>(0), m.at<double>(1), m.at<double>(2));
  };
  return {ExpRotation(vector(rotation_vector)), vector(translation)};
}

}  // namespace

double PoseRmsPx(const Lens& lens, const Board& board, const BoardCorners& corners,
                 const RigidTransform& X_CB) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.ids.size(); ++i) {
    const Vector3 p_C = X_CB * board.Corner(corners.ids[i]);
    if (p_C.z() <= 0) return HUGE_VAL;
    const auto pixel = PixelFromNormalized(lens, p_C.head<2>() / p_C.z());
    if (!pixel) return HUGE_VAL;
    sum += (*pixel - corners.pixels[i]).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(corners.ids.size()));
}

std::vector<BoardPose> FindBoardPoses(const Lens& lens, const Board& board,
                                      const BoardCorners& corners) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> normalized;
  for (std::size_t i = 0; i < corners.ids.size(); ++i) {
    const auto n = NormalizedFromPixel(lens, corners.pixels[i]);
    if (!n) continue;
    const Vector3 p_B = board.Corner(corners.ids[i]);
    points.emplace_back(p_B.x(), p_B.y(), 0.0);
    normalized.emplace_back(n->x(), n->y());
  }
  if (points.size() < 4) return {};
  std::vector<cv::Mat> rotations, translations;
  cv::solvePnPGeneric(points, normalized, cv::Matx33d::eye(), cv::noArray(), rotations,
                      translations, false, cv::SOLVEPNP_IPPE);
  std::vector<BoardPose> poses;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    cv::solvePnPRefineLM(points, normalized, cv::Matx33d::eye(), cv::noArray(), rotations[i],
                         translations[i]);
    const RigidTransform X_CB = FromOpenCv(rotations[i], translations[i]);
    const double rms_px = PoseRmsPx(lens, board, corners, X_CB);
    if (std::isfinite(rms_px)) poses.push_back({X_CB, rms_px});
  }
  std::sort(poses.begin(), poses.end(),
            [](const BoardPose& a, const BoardPose& b) { return a.rms_px < b.rms_px; });
  return poses;
}

}  // namespace mocap
