// V4L2 cameras, found by name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "drivers/camera_listing.h"
#include "drivers/v4l2/video_kernel.h"

namespace mocap {

/// The system's device folders; tests use their own.
struct DeviceTree {
  std::filesystem::path dev = "/dev";
  std::filesystem::path sys = "/sys";
  std::filesystem::path udev_links = "/run/udev/links";
};

/// A node that delivers pictures.
struct V4l2Node {
  std::string path;  ///< Such as /dev/video0.
  std::string model;
  std::string kernel_driver;
  std::string bus;         ///< Such as "usb-0000:00:14.0-2": controller and port.
  std::string serial;      ///< Of the USB device; empty: it has none.
  double link_mbit_s = 0;  ///< USB bandwidth; 0: not on USB.

  /// Identifies the camera when it returns under another number.
  const std::string& identity() const { return serial.empty() ? bus : serial; }
  /// The controller, whose bandwidth is shared: the bus without the port.
  std::string controller() const;
};

/// Lists all nodes that deliver pictures; not those for metadata, output or codecs.
std::vector<V4l2Node> FindV4l2Nodes(VideoKernel& kernel, const DeviceTree& tree = {});

/// Finds the camera with a path (/dev/video0, a link in /dev/v4l), a bus or a serial number.
/// @throws SetupError  when there is none, when there are several, or when it gives no pictures.
V4l2Node FindV4l2Node(VideoKernel& kernel, const std::string& name, const DeviceTree& tree = {});

/// Lists the cameras with their formats.
std::vector<ListedCamera> ListV4l2Cameras(VideoKernel& kernel, const DeviceTree& tree = {});

}  // namespace mocap
