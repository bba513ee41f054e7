#include "tools/take_samples.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <span>

#include "config/config.h"
#include "config/load_config.h"
#include "config/open_studio.h"
#include "config/room_limits.h"
#include "core/reconstruction/camera/sensor_plane_table.h"
#include "core/reconstruction/carving/carver.h"
#include "core/reconstruction/carving/floor_shadows.h"
#include "core/reconstruction/carving/miss_rates.h"
#include "core/reconstruction/silhouette/segmenter.h"
#include "daemon/pipeline/pipeline.h"
#include "drivers/take/take_layout.h"

namespace mocap {
namespace {

/// The frame nearest to a moment found so far.
struct Nearest {
  std::int64_t apart_ns = std::numeric_limits<std::int64_t>::max();
  Image<Bgr> image;
  PanTiltAngles angles;
};

Image<Bgr> Copy(ImageView<const Bgr> view) {
  Image<Bgr> image(view.width(), view.height());
  for (int y = 0; y < view.height(); ++y) {
    std::copy_n(view.row(y), view.width(), image.row(y));
  }
  return image;
}

std::vector<Nearest> NearestFrames(CameraDriver& driver, const std::vector<SampleRequest>& requests,
                                   std::int64_t tolerance_ns) {
  std::vector<Nearest> nearest(requests.size());
  std::int64_t last_ns = 0;
  for (const SampleRequest& request : requests) last_ns = std::max(last_ns, request.timestamp_ns);
  driver.Start();
  Frame frame;
  // As fast as possible, a recording never times out; a timeout is not its end.
  for (;;) {
    const GrabStatus status = driver.Grab(frame, std::chrono::milliseconds(1000));
    if (status == GrabStatus::kEnd || status == GrabStatus::kLost) break;
    if (status != GrabStatus::kFrame) continue;
    if (frame.capture_ns > last_ns + tolerance_ns) break;
    for (std::size_t i = 0; i < requests.size(); ++i) {
      const std::int64_t apart_ns = std::abs(frame.capture_ns - requests[i].timestamp_ns);
      if (apart_ns > tolerance_ns || apart_ns >= nearest[i].apart_ns) continue;
      nearest[i] = {apart_ns, Copy(frame.image), frame.angles};
    }
  }
  driver.Stop();
  return nearest;
}

/// @param shadings  by camera, then by moment.
void Carve(std::span<const std::vector<Shading>> shadings, double voxel_mm, TakeSamples& samples) {
  std::vector<SensorPlaneTable> tables(samples.cameras.begin(), samples.cameras.end());
  FloorShadows shadows(samples.cameras);
  Carver carver({voxel_mm});
  for (std::size_t m = 0; m < samples.moments.size(); ++m) {
    SampledMoment& moment = samples.moments[m];
    std::vector<ShadedView> shaded;
    for (std::size_t c = 0; c < shadings.size(); ++c) {
      if (!moment.views[c]) continue;
      SampledView& view = *moment.views[c];
      shaded.push_back({static_cast<int>(c), &tables[c], view.X_CW, &shadings[c][m], &view.trimap});
    }
    shadows.Complete(shaded);
    std::vector<CarvingView> views;
    for (std::size_t c = 0; c < tables.size(); ++c) {
      if (!moment.views[c]) continue;
      const SampledView& view = *moment.views[c];
      views.push_back({&tables[c], &view.trimap.person, view.X_CW, &view.trimap.unknown});
    }
    WeighOnce(views, false);
    carver.Carve(views, moment.voxels);
  }
}

/// A camera list that is written as a calibration must keep cameras without frames.
void AddSilentCameras(const std::filesystem::path& take, TakeSamples& samples) {
  for (const CameraCalibration& camera : LoadCalibration(TakeLayout{take}.Calibration())) {
    if (std::ranges::find(samples.cameras, camera.name, &CameraCalibration::name) !=
        samples.cameras.end())
      continue;
    samples.cameras.push_back(camera);
    for (SampledMoment& moment : samples.moments) moment.views.emplace_back();
  }
}

}  // namespace

TakeSamples SampleTake(const std::filesystem::path& take,
                       const std::vector<SampleRequest>& requests, double voxel_mm) {
  Studio studio = OpenTake(take, {});
  RequireCameraCount(studio);
  RequireRoom(CalibrationsOf(studio), voxel_mm, TakeLayout{take}.Calibration().string());
  const std::int64_t tolerance_ns = std::llround(0.5e9 / studio.fps_nominal);
  TakeSamples samples;
  samples.remarks = studio.remarks;
  for (const SampleRequest& request : requests) {
    samples.moments.push_back({request.timestamp_ns, {}, {}});
    samples.moments.back().views.resize(studio.cameras.size());
  }
  std::vector<std::vector<Shading>> shadings(studio.cameras.size());
  // One camera at a time, to keep only its pictures and background in memory.
  for (std::size_t c = 0; c < studio.cameras.size(); ++c) {
    StudioCamera& camera = studio.cameras[c];
    samples.cameras.push_back(camera.calibration);
    Segmenter segmenter(camera.calibration, camera.background(), SegmentationOptions{});
    std::vector<Nearest> nearest = NearestFrames(*camera.driver, requests, tolerance_ns);
    shadings[c].resize(requests.size());
    for (std::size_t i = 0; i < requests.size(); ++i) {
      if (nearest[i].image.empty()) continue;
      SampledView& view = samples.moments[i].views[c].emplace();
      view.X_CW = camera.calibration.PoseAt(nearest[i].angles);
      segmenter.Segment(nearest[i].image.view(), nearest[i].angles, view.trimap);
      shadings[c][i] = segmenter.shading();
      if (requests[i].keep_images) view.image = std::move(nearest[i].image);
    }
  }
  AddSilentCameras(take, samples);
  Carve(shadings, voxel_mm, samples);
  return samples;
}

}  // namespace mocap
