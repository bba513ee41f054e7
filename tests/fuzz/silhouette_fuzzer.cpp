// What comes from a node's network: silhouettes, nodes' statuses, packed pictures.
#include "daemon/nodes/node_listener.h"
#include "daemon/nodes/picture_packing.h"

namespace {

constexpr int kWidth = 160, kHeight = 120;

mocap::CameraCalibration Camera() {
  mocap::CameraCalibration camera;
  camera.name = "cam1";
  camera.width_px = kWidth;
  camera.height_px = kHeight;
  mocap::OpenCvLens lens;
  lens.K << 120, 0, kWidth / 2.0, 0, 120, kHeight / 2.0, 0, 0, 1;
  camera.lens = lens;
  return camera;
}

mocap::Config Studio() {
  mocap::Config config;
  config.role = mocap::Role::kStudio;
  config.nodes = {{"left", {"cam1"}, {}}};
  return config;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const mocap::CameraCalibration camera = Camera();
  static mocap::NodeListener listener(Studio(), std::span(&camera, 1));
  const std::span<const std::uint8_t> bytes(data, size);
  listener.OnSilhouette(bytes);
  listener.OnNode(bytes);
  listener.LookRound();
  listener.Report();
  mocap::Trimap trimap;
  mocap::Shading shading;
  mocap::UnpackPicture(bytes, kWidth, kHeight, trimap, shading);
  return 0;
}
