#include "tools/calibration/bundle_errors.h"

#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

constexpr double kLeastOutlier_px = 1, kOutlierMedians = 3;
constexpr int kFewestCorners = 4;

}  // namespace

std::vector<CornerError> BundleErrors(const BoardDetections& detections, const Bundle& bundle) {
  std::vector<CornerError> errors;
  for (std::size_t s = 0; s < detections.detections.size(); ++s) {
    const BoardDetection& detection = detections.detections[s];
    if (!bundle.X_WB[detection.moment]) continue;
    const CameraCalibration& camera = bundle.cameras[detection.camera];
    const RigidTransform X_CB = camera.X_CW * *bundle.X_WB[detection.moment];
    const double lateness_s = bundle.lateness_s.empty() ? 0 : bundle.lateness_s[detection.camera];
    for (std::size_t i = 0; i < detection.corners.ids.size(); ++i) {
      const Vector3 p_C = X_CB * detections.board.Corner(detection.corners.ids[i]);
      CornerError error{static_cast<int>(s), detection.corners.pixels[i],
                        Vector2::Constant(HUGE_VAL), p_C.z()};
      if (p_C.z() > 0) {
        const auto pixel = PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
        if (pixel) error.error_px = *pixel - error.pixel + detection.MovedSince(i, lateness_s);
      }
      errors.push_back(error);
    }
  }
  return errors;
}

double RmsPx(const std::vector<CornerError>& errors, const BoardDetections& detections,
             int camera) {
  double sum = 0;
  int count = 0;
  for (const CornerError& error : errors) {
    if (camera >= 0 && detections.detections[error.detection].camera != camera) continue;
    sum += error.error_px.squaredNorm();
    ++count;
  }
  return count == 0 ? 0 : std::sqrt(sum / count);
}

ViewError WorstView(const std::vector<CornerError>& errors, const BoardDetections& detections,
                    int camera) {
  ViewError worst{"no frame", 0};
  for (std::size_t i = 0; i < errors.size();) {
    const int detection = errors[i].detection;
    double sum = 0;
    int count = 0;
    for (; i < errors.size() && errors[i].detection == detection; ++i, ++count)
      sum += errors[i].error_px.squaredNorm();
    const double rms_px = std::sqrt(sum / count);
    if (detections.detections[detection].camera == camera && rms_px > worst.rms_px)
      worst = {detections.detections[detection].name, rms_px};
  }
  return worst;
}

int DropOutliers(const Bundle& bundle, BoardDetections& detections) {
  const std::vector<CornerError> errors = BundleErrors(detections, bundle);
  if (errors.empty()) return 0;
  std::vector<double> lengths;
  for (const CornerError& error : errors) lengths.push_back(error.error_px.norm());
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  const double limit = std::max(kLeastOutlier_px, kOutlierMedians * *middle);
  std::vector<BoardCorners> kept(detections.detections.size());
  std::vector<std::vector<CornerMotion>> motions(detections.detections.size());
  std::vector<std::size_t> next(detections.detections.size(), 0);
  int dropped = 0;
  for (const CornerError& error : errors) {
    const BoardCorners& corners = detections.detections[error.detection].corners;
    const std::size_t i = next[error.detection]++;
    if (!(error.error_px.norm() <= limit)) {
      ++dropped;
      continue;
    }
    kept[error.detection].ids.push_back(corners.ids[i]);
    kept[error.detection].pixels.push_back(corners.pixels[i]);
    if (!detections.detections[error.detection].motions.empty())
      motions[error.detection].push_back(detections.detections[error.detection].motions[i]);
  }
  for (std::size_t s = 0; s < kept.size(); ++s) {
    if (next[s] == 0) continue;
    detections.detections[s].corners = kept[s];
    detections.detections[s].motions = motions[s];
  }
  const int fewest = std::min(kFewestCorners, detections.board.corners());
  std::erase_if(detections.detections, [fewest](const BoardDetection& s) {
    return static_cast<int>(s.corners.ids.size()) < fewest;
  });
  return dropped;
}

}  // namespace mocap
