// What comes from clients: keypoints, and requests for pictures.
#include "daemon/messages/client_listener.h"
#include "daemon/messages/look_wants.h"

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
  static mocap::KeypointTap keypoint_tap;
  static mocap::LookWants wants;
  static mocap::ClientListener listener(
      {}, Cameras(), mocap::CaptureTimes::kRecorded, inbox, tap, keypoint_tap,
      [](const mocap::look_request_t& request) { wants.Take(request, 0); });
  std::vector<mocap::KeypointView> views;
  inbox.TakeFor(1'000'000'000, views);
  listener.OnKeypoints(std::span(data, size));
  listener.OnLookRequest(std::span(data, size));
  wants.At(1);
  inbox.Report(0);
  inbox.TakeFor(2'000'000'000, views);
  return 0;
}
