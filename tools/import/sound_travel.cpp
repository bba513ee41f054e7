#include "tools/import/sound_travel.h"

#include <cmath>
#include <numbers>

#include "tools/calibration/studio_check.h"

namespace mocap {
namespace {

/// At 20 °C [mm/s].
constexpr double kSpeedOfSound_mm_s = 343e3;
constexpr double kFromMiddle_mm = 1000;
constexpr int kPlaces = 12;

/// From a place to each camera [s].
std::vector<double> TravelsFrom(const Vector3& place_W,
                                std::span<const CameraCalibration> cameras) {
  std::vector<double> travels_s;
  for (const CameraCalibration& camera : cameras)
    travels_s.push_back((camera.X_CW * place_W).norm() / kSpeedOfSound_mm_s);
  return travels_s;
}

}  // namespace

std::vector<SoundTravel> SoundTravels(std::span<const CameraCalibration> cameras) {
  const Vector3 middle_W = MiddleOfRoom({cameras.begin(), cameras.end()});
  std::vector<SoundTravel> travels;
  for (const double travel_s : TravelsFrom(middle_W, cameras)) travels.push_back({travel_s, 0});
  for (int i = 0; i < kPlaces; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPlaces;
    std::vector<double> later_s = TravelsFrom(
        middle_W + kFromMiddle_mm * Vector3(std::cos(angle), std::sin(angle), 0), cameras);
    double mean_s = 0;
    for (std::size_t c = 0; c < travels.size(); ++c) {
      later_s[c] -= travels[c].from_middle_s;
      mean_s += later_s[c] / static_cast<double>(travels.size());
    }
    for (std::size_t c = 0; c < travels.size(); ++c)
      travels[c].sigma_s += (later_s[c] - mean_s) * (later_s[c] - mean_s) / kPlaces;
  }
  for (SoundTravel& travel : travels) travel.sigma_s = std::sqrt(travel.sigma_s);
  return travels;
}

}  // namespace mocap
