#include "config/open_live.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>

#include "config/camera_files.h"
#include "config/load_config.h"
#include "core/errors.h"
#include "drivers/aravis/aravis_driver.h"
#include "drivers/nearest_name.h"
#include "drivers/pan_tilt_camera.h"
#include "drivers/take/calibration_file.h"
#include "drivers/take/input_file.h"
#include "drivers/usb/uvc_pan_tilt.h"
#include "drivers/v4l2/v4l2_driver.h"
#include "drivers/v4l2/v4l2_pan_tilt.h"

namespace mocap {
namespace {

std::unique_ptr<CameraDriver> MakeDriver(const std::string& driver, const CameraConfig& camera,
                                         const CameraRequest& request) {
  if (driver == "v4l2") return std::make_unique<V4l2Driver>(request, camera.v4l2);
  return std::make_unique<AravisDriver>(request, camera.aravis);
}

std::unique_ptr<PanTilt> MakeHead(const CameraConfig& camera) {
  if (camera.head.kind == HeadKind::kFixed) {
    return std::make_unique<FixedPanTilt>(camera.head.angles);
  }
  const auto delay = std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double, std::milli>(camera.head.delay_ms));
  if (camera.head.kind == HeadKind::kUvc) {
    return std::make_unique<UvcPanTilt>(camera.head.device, delay);
  }
  return std::make_unique<V4l2PanTilt>(camera.device, delay);
}

/// Mounts the camera on its pan-tilt head.
void Mount(const CameraConfig& camera, const std::shared_ptr<SubjectPosition>& person,
           LiveCamera& live) {
  if (camera.head.kind == HeadKind::kNone) return;
  constexpr std::array<double, 2> kAnywhere{-1e3, 1e3};
  const auto pan = camera.head.pan_range_rad.value_or(kAnywhere);
  const auto tilt = camera.head.tilt_range_rad.value_or(kAnywhere);
  live.range = {{pan[0], tilt[0]}, {pan[1], tilt[1]}};
  std::optional<HeadFollower> follower;
  if (camera.head.follow && person && live.calibration && live.calibration->head) {
    follower.emplace(*live.calibration, live.range, person);
  }
  auto mounted = std::make_unique<PanTiltCamera>(std::move(live.driver), MakeHead(camera),
                                                 std::move(follower));
  live.head = &mounted->head();
  live.driver = std::move(mounted);
}

/// Calibrated angles require a pan-tilt head and vice versa: a mismatch would be wrong silently.
void RequireHeadOrNone(const LiveCamera& live, const std::filesystem::path& calibration) {
  const bool is_calibrated = live.calibration->head.has_value();
  if (is_calibrated == (live.head != nullptr)) return;
  const std::string table = "cameras." + live.name + ".pan_tilt";
  throw SetupError(calibration.string() + ": " + table +
                   (is_calibrated ? " exists, but [[cameras]] gives " + live.name +
                                        " no head; expected head = \"v4l2\", \"uvc\" or \"fixed\""
                                  : " is missing, but [[cameras]] gives " + live.name + " a head"));
}

std::string SizeText(int width_px, int height_px) {
  return std::to_string(width_px) + " x " + std::to_string(height_px);
}

CameraCalibration FindCalibration(const std::vector<CameraCalibration>& calibrations,
                                  const CameraConfig& camera, const std::filesystem::path& file) {
  const auto found = std::ranges::find(calibrations, camera.name, &CameraCalibration::name);
  if (found == calibrations.end()) {
    const std::vector<std::string> names = CameraNames(calibrations);
    throw SetupError(file.string() + ": cameras." + camera.name +
                     " is missing, but [[cameras]] names it; " +
                     WithNearestName(camera.name, names, "the file has " + ListedNames(names)));
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

/// The only camera whose strobe can be wired to this one's trigger. Cameras cannot be asked how
/// they are wired: if two have a strobe, nothing is guessed.
std::string MasterOf(const Config& config, const CameraConfig& camera) {
  if (config.source.driver != "aravis" || !camera.aravis.waits_for_line()) return "";
  const auto has_strobe = [](const CameraConfig& other) { return !other.aravis.strobe.empty(); };
  if (std::ranges::count_if(config.cameras, has_strobe) != 1) return "";
  const std::string& master = std::ranges::find_if(config.cameras, has_strobe)->name;
  return master == camera.name ? "" : master;
}

}  // namespace

std::vector<LiveCamera> OpenLiveCameras(const Config& config,
                                        const std::shared_ptr<SubjectPosition>& person) {
  if (!IsLive(config.source)) {
    throw SetupError("source.driver is \"" + config.source.driver +
                     "\", which has no live cameras; expected \"v4l2\" or \"aravis\"");
  }
  std::vector<CameraCalibration> calibrations;
  if (IsThere(config.calibration)) {
    calibrations = LoadCalibration(config.calibration);
  }
  std::vector<LiveCamera> cameras;
  for (const CameraConfig& camera : config.cameras) {
    LiveCamera& live = cameras.emplace_back();
    live.name = camera.name;
    if (!calibrations.empty())
      live.calibration = FindCalibration(calibrations, camera, config.calibration);
    live.request = RequestFor(config, camera, live.calibration);
    live.waits_for = MasterOf(config, camera);
    live.driver = MakeDriver(config.source.driver, camera, live.request);
    Mount(camera, person, live);
    if (live.calibration) RequireHeadOrNone(live, config.calibration);
  }
  return cameras;
}

Studio OpenLiveStudio(const Config& config) {
  if (!IsThere(config.calibration)) {
    throw SetupError(WhereOf(config, "calibration") + " is " + config.calibration.string() +
                     ", which is not there; `mocap calibrate studio` makes one");
  }
  if (!IsThere(config.background)) {
    throw SetupError(WhereOf(config, "background") + " is " + config.background.string() +
                     ", which is not there; `mocap background learn --config FILE` makes it while "
                     "the studio is empty");
  }
  RequireFolder(config.background,
                "what `mocap background learn --config FILE` makes while the studio is empty");
  Studio studio{"live studio", 0, {}};
  if (std::ranges::any_of(config.cameras, [](const auto& c) { return c.head.follow; })) {
    studio.person = std::make_shared<SubjectPosition>();
  }
  for (LiveCamera& live : OpenLiveCameras(config, studio.person)) {
    const std::filesystem::path base = config.background / live.name;
    studio.fps_nominal = std::max(studio.fps_nominal, live.request.fps);
    auto background =
        OpenCameraBackground(base.string() + ".mkv", base.string() + ".csv", *live.calibration);
    studio.cameras.push_back({std::move(*live.calibration), std::move(live.driver),
                              std::move(background), live.request.fps, std::move(live.waits_for)});
  }
  return studio;
}

}  // namespace mocap
