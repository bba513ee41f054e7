#include "tools/calibration/bundle_errors.h"

#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

constexpr double kLeastOutlier_px = 1, kOutlierMedians = 3;
constexpr int kFewestCorners = 4;

}  // namespace

std::vector<CornerError> BundleErrors(const BoardSightings& sightings, const Bundle& bundle) {
  std::vector<CornerError> errors;
  for (std::size_t s = 0; s < sightings.sightings.size(); ++s) {
    const BoardSighting& sighting = sightings.sightings[s];
    if (!bundle.X_WB[sighting.moment]) continue;
    const CameraCalibration& camera = bundle.cameras[sighting.camera];
    const RigidTransform X_CB = camera.X_CW * *bundle.X_WB[sighting.moment];
    const double lateness_s = bundle.lateness_s.empty() ? 0 : bundle.lateness_s[sighting.camera];
    for (std::size_t i = 0; i < sighting.corners.ids.size(); ++i) {
      const Vector3 p_C = X_CB * sightings.board.Corner(sighting.corners.ids[i]);
      CornerError error{static_cast<int>(s), sighting.corners.pixels[i],
                        Vector2::Constant(HUGE_VAL), p_C.z()};
      if (p_C.z() > 0) {
        const auto pixel = PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
        if (pixel) error.error_px = *pixel - error.pixel + sighting.MovedSince(i, lateness_s);
      }
      errors.push_back(error);
    }
  }
  return errors;
}

double RmsPx(const std::vector<CornerError>& errors, const BoardSightings& sightings, int camera) {
  double sum = 0;
  int count = 0;
  for (const CornerError& error : errors) {
    if (camera >= 0 && sightings.sightings[error.sighting].camera != camera) continue;
    sum += error.error_px.squaredNorm();
    ++count;
  }
  return count == 0 ? 0 : std::sqrt(sum / count);
}

ViewError WorstView(const std::vector<CornerError>& errors, const BoardSightings& sightings,
                    int camera) {
  ViewError worst{"no frame", 0};
  for (std::size_t i = 0; i < errors.size();) {
    const int sighting = errors[i].sighting;
    double sum = 0;
    int count = 0;
    for (; i < errors.size() && errors[i].sighting == sighting; ++i, ++count)
      sum += errors[i].error_px.squaredNorm();
    const double rms_px = std::sqrt(sum / count);
    if (sightings.sightings[sighting].camera == camera && rms_px > worst.rms_px)
      worst = {sightings.sightings[sighting].name, rms_px};
  }
  return worst;
}

int DropOutliers(const Bundle& bundle, BoardSightings& sightings) {
  const std::vector<CornerError> errors = BundleErrors(sightings, bundle);
  if (errors.empty()) return 0;
  std::vector<double> lengths;
  for (const CornerError& error : errors) lengths.push_back(error.error_px.norm());
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  const double limit = std::max(kLeastOutlier_px, kOutlierMedians * *middle);
  std::vector<BoardCorners> kept(sightings.sightings.size());
  std::vector<std::vector<CornerMotion>> motions(sightings.sightings.size());
  std::vector<std::size_t> next(sightings.sightings.size(), 0);
  int dropped = 0;
  for (const CornerError& error : errors) {
    const BoardCorners& corners = sightings.sightings[error.sighting].corners;
    const std::size_t i = next[error.sighting]++;
    if (!(error.error_px.norm() <= limit)) {
      ++dropped;
      continue;
    }
    kept[error.sighting].ids.push_back(corners.ids[i]);
    kept[error.sighting].pixels.push_back(corners.pixels[i]);
    if (!sightings.sightings[error.sighting].motions.empty())
      motions[error.sighting].push_back(sightings.sightings[error.sighting].motions[i]);
  }
  for (std::size_t s = 0; s < kept.size(); ++s) {
    if (next[s] == 0) continue;
    sightings.sightings[s].corners = kept[s];
    sightings.sightings[s].motions = motions[s];
  }
  const int fewest = std::min(kFewestCorners, sightings.board.corners());
  std::erase_if(sightings.sightings, [fewest](const BoardSighting& s) {
    return static_cast<int>(s.corners.ids.size()) < fewest;
  });
  return dropped;
}

}  // namespace mocap
