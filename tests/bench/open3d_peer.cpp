// Open3D's carving of the same silhouettes in the same room, where Open3D is installed.
#include <benchmark/benchmark.h>
#include <open3d/camera/PinholeCameraParameters.h>
#include <open3d/geometry/Image.h>
#include <open3d/geometry/VoxelGrid.h>

#include <memory>
#include <vector>

#include "tests/bench/recorded_studio.h"

namespace mocap::bench {
namespace {

constexpr double kVoxel_mm = 25;
const Vector3 kRoom_mm(4000, 4000, 2200);  // 160 × 160 × 88 voxels.

open3d::geometry::Image MaskOf(const Silhouette& silhouette) {
  open3d::geometry::Image mask;
  mask.Prepare(silhouette.width(), silhouette.height(), 1, sizeof(float));
  for (int y = 0; y < silhouette.height(); ++y)
    for (int x = 0; x < silhouette.width(); ++x)
      *mask.PointerAt<float>(x, y) = silhouette.Test(x, y) ? 1 : 0;
  return mask;
}

// It knows no distortion: the camera is the one whose middle looks the same.
open3d::camera::PinholeCameraParameters CameraOf(const CameraCalibration& camera) {
  const Vector2 middle_px(camera.width_px / 2.0, camera.height_px / 2.0);
  const Vector2 middle = *NormalizedFromPixel(camera.lens, middle_px);
  const Vector2 right = *NormalizedFromPixel(camera.lens, middle_px + Vector2(1, 0));
  const double focal_px = 1 / (right - middle).norm();
  open3d::camera::PinholeCameraParameters parameters;
  parameters.intrinsic_.SetIntrinsics(camera.width_px, camera.height_px, focal_px, focal_px,
                                      middle_px.x() - focal_px * middle.x(),
                                      middle_px.y() - focal_px * middle.y());
  parameters.extrinsic_.setIdentity();
  parameters.extrinsic_.topLeftCorner<3, 3>() = camera.X_CW.R;
  parameters.extrinsic_.topRightCorner<3, 1>() = camera.X_CW.p;
  return parameters;
}

void CarveByOpen3d(benchmark::State& state) {
  const RecordedStudio& studio = RecordedStudio::Get({});
  std::vector<open3d::geometry::Image> masks;
  std::vector<open3d::camera::PinholeCameraParameters> cameras;
  for (const CarvingView& view : studio.Views(0)) masks.push_back(MaskOf(*view.silhouette));
  for (const CameraCalibration& camera : studio.cameras()) cameras.push_back(CameraOf(camera));
  const Vector3 origin_W(-kRoom_mm.x() / 2, -kRoom_mm.y() / 2, 0);
  std::size_t left = 0;
  for (auto _ : state) {
    const auto grid = open3d::geometry::VoxelGrid::CreateDense(
        origin_W, Vector3::Zero(), kVoxel_mm, kRoom_mm.x(), kRoom_mm.y(), kRoom_mm.z());
    for (std::size_t i = 0; i < masks.size(); ++i)
      grid->CarveSilhouette(masks[i], cameras[i], false);
    left = grid->voxels_.size();
  }
  state.counters["voxels"] = static_cast<double>(left);
}

BENCHMARK(CarveByOpen3d)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mocap::bench
