#include "config/open_live.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "config/camera_files.h"
#include "config/load_config.h"
#include "core/errors.h"
#include "drivers/aravis_driver.h"
#include "drivers/v4l2_driver.h"

namespace mocap {
namespace {

std::unique_ptr<CameraDriver> MakeDriver(const std::string& driver, const CameraConfig& camera,
                                         const CameraRequest& request) {
  if (driver == "v4l2") return std::make_unique<V4l2Driver>(request, camera.v4l2);
  return std::make_unique<AravisDriver>(request, camera.aravis);
}

std::string SizeText(int width_px, int height_px) {
  return std::to_string(width_px) + " x " + std::to_string(height_px);
}

CameraCalibration Find(const std::vector<CameraCalibration>& calibrations,
                       const CameraConfig& camera, const std::filesystem::path& file) {
  const auto found = std::ranges::find(calibrations, camera.name, &CameraCalibration::name);
  if (found == calibrations.end()) {
    std::string known;
    for (const CameraCalibration& other : calibrations) {
      known += (known.empty() ? "" : ", ") + other.name;
    }
    throw SetupError(file.string() + ": cameras." + camera.name +
                     " is missing, which [[cameras]] names; it has " + known);
  }
  const std::array<int, 2> size{found->width_px, found->height_px};
  if (camera.size_px.value_or(size) != size) {
    throw SetupError("cameras." + camera.name + ": size_px is " +
                     SizeText((*camera.size_px)[0], (*camera.size_px)[1]) +
                     ", but the camera is calibrated for " + SizeText(size[0], size[1]));
  }
  return *found;
}

CameraRequest RequestFor(const Config& config, const CameraConfig& camera,
                         const std::optional<CameraCalibration>& calibration) {
  CameraRequest request;
  request.device = camera.device;
  request.fps = camera.fps.value_or(config.source.fps);
  if (calibration) {
    request.width_px = calibration->width_px;
    request.height_px = calibration->height_px;
  } else if (camera.size_px) {
    request.width_px = (*camera.size_px)[0];
    request.height_px = (*camera.size_px)[1];
  }
  return request;
}

}  // namespace

std::vector<LiveCamera> OpenLiveCameras(const Config& config) {
  if (!IsLive(config.source)) {
    throw SetupError("source.driver is \"" + config.source.driver +
                     "\", which has no live cameras; \"v4l2\" or \"aravis\" is wanted");
  }
  std::vector<CameraCalibration> calibrations;
  if (std::filesystem::exists(config.calibration)) {
    calibrations = LoadCalibration(config.calibration);
  }
  std::vector<LiveCamera> cameras;
  for (const CameraConfig& camera : config.cameras) {
    LiveCamera& live = cameras.emplace_back();
    live.name = camera.name;
    if (!calibrations.empty()) live.calibration = Find(calibrations, camera, config.calibration);
    live.request = RequestFor(config, camera, live.calibration);
    live.driver = MakeDriver(config.source.driver, camera, live.request);
  }
  return cameras;
}

Studio OpenLiveStudio(const Config& config) {
  if (!std::filesystem::exists(config.calibration)) {
    throw SetupError(config.calibration.string() +
                     ": is missing; `mocap calibrate studio` makes one");
  }
  if (!std::filesystem::is_directory(config.background)) {
    throw SetupError(config.background.string() +
                     ": is missing; `mocap background learn` makes it while the studio is empty");
  }
  Studio studio{"live studio", 0, {}};
  for (LiveCamera& live : OpenLiveCameras(config)) {
    if (live.calibration->head) {
      throw SetupError(config.calibration.string() + ": cameras." + live.name +
                       ".pan_tilt: heads of live cameras are not supported");
    }
    const std::filesystem::path base = config.background / live.name;
    studio.fps_nominal = std::max(studio.fps_nominal, live.request.fps);
    auto background =
        OpenCameraBackground(base.string() + ".mkv", base.string() + ".csv", *live.calibration);
    studio.cameras.push_back(
        {std::move(*live.calibration), std::move(live.driver), std::move(background)});
  }
  return studio;
}

}  // namespace mocap
