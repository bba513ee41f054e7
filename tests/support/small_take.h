// Takes so small that each test makes its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "drivers/take/take_writer.h"

namespace mocap::testing {

struct SmallTake {
  int cameras = 3;
  int frames = 12;
  int width_px = 68;  ///< Not a multiple of what vector code likes.
  int height_px = 50;
  bool heads = false;
  std::int64_t first_ns = 1'000'000'000'000;
  std::int64_t interval_ns = 40'000'000;

  /// Cameras expose one after the other.
  std::int64_t TimeNs(int camera, int frame) const {
    return first_ns + camera * 1'000'000 + frame * interval_ns;
  }
  PanTiltAngles Angles(int camera, int frame) const {
    return heads ? PanTiltAngles{0.01 * frame, -0.1 * camera} : PanTiltAngles{};
  }
};

/// A picture that no other camera and frame has, noisy enough that no pixel is like its neighbour.
inline Image<Bgr> SmallPicture(const SmallTake& take, int camera, int frame) {
  Image<Bgr> image(take.width_px, take.height_px);
  std::uint32_t state = 0x9e3779b9u * static_cast<std::uint32_t>(1 + camera * 1000 + frame);
  for (Bgr& pixel : image.pixels()) {
    state = state * 1664525u + 1013904223u;
    pixel = {static_cast<std::uint8_t>(state >> 24), static_cast<std::uint8_t>(state >> 16),
             static_cast<std::uint8_t>(state >> 12)};
  }
  return image;
}

inline CameraCalibration SmallCamera(const SmallTake& take, int camera) {
  CameraCalibration calibration;
  calibration.name = "cam" + std::to_string(camera + 1);
  calibration.width_px = take.width_px;
  calibration.height_px = take.height_px;
  TsaiLens lens;
  lens.focal_mm = 5.4 + 0.1 * camera;
  lens.kappa1 = 0.0025;
  lens.sx = 0.998;
  lens.center_px = {take.width_px / 2.0 + 0.3, take.height_px / 2.0 - 0.2};
  lens.pitch_mm = {0.01, 0.0099};
  calibration.lens = lens;
  calibration.X_CW = {ExpRotation({0.3, 0.1 * camera, -0.2}), {10.0 * camera, 800, 4600}};
  if (take.heads) {
    calibration.head =
        PanTiltHead{Vector3::UnitZ(), {1, 2, 3}, Vector3(0.6, 0.8, 0), {4, 5, 6.5}, 1, 1, {}};
  }
  return calibration;
}

inline TakeDescription SmallDescription(const SmallTake& take) {
  TakeDescription description;
  description.name = "small";
  description.fps_nominal = 25;
  for (int camera = 0; camera < take.cameras; ++camera) {
    description.cameras.push_back(SmallCamera(take, camera));
  }
  description.notes = {{"source", "a test"}};
  return description;
}

/// Writes frames, times and background of all cameras.
inline void WriteSmallTake(const std::filesystem::path& folder, const SmallTake& take = {}) {
  TakeWriter writer(folder, SmallDescription(take));
  constexpr int kBackgroundFrames = 3;
  for (int camera = 0; camera < take.cameras; ++camera) {
    for (int frame = 0; frame < kBackgroundFrames; ++frame) {
      writer.WriteBackground(camera, SmallPicture(take, camera, 100 + frame).view(),
                             take.TimeNs(camera, frame), take.Angles(camera, frame));
    }
    for (int frame = 0; frame < take.frames; ++frame) {
      writer.WriteFrame(camera, SmallPicture(take, camera, frame).view(),
                        take.TimeNs(camera, frame), take.Angles(camera, frame));
    }
  }
  writer.Finish();
}

}  // namespace mocap::testing
