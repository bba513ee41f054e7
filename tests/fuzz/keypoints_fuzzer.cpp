// What comes from clients: keypoints.
#include "daemon/messages/client_listener.h"

namespace {

std::vector<mocap::CameraCalibration> Cameras() {
  mocap::CameraCalibration camera;
  camera.name = "cam1";
  camera.width_px = 640;
  camera.height_px = 480;
  return {camera};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static mocap::KeypointInbox inbox;
  static mocap::MessageTap tap;
  static mocap::ClientListener listener({}, Cameras(), mocap::CaptureTimes::kRecorded, inbox, tap);
  std::vector<mocap::KeypointView> views;
  inbox.TakeFor(1'000'000'000, views);
  listener.OnKeypoints(std::span(data, size));
  inbox.Report(0);
  inbox.TakeFor(2'000'000'000, views);
  return 0;
}
