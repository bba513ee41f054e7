// Which V4L2 cameras there are, and which one a name means.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "drivers/camera_listing.h"
#include "drivers/v4l2/video_kernel.h"

namespace mocap {

/// Where the system tells of its devices; tests have a tree of their own.
struct DeviceTree {
  std::filesystem::path dev = "/dev";
  std::filesystem::path sys = "/sys";
  std::filesystem::path udev_links = "/run/udev/links";
};

/// A node that gives pictures.
struct V4l2Node {
  std::string path;  ///< As /dev/video0.
  std::string model;
  std::string kernel_driver;
  std::string bus;         ///< As "usb-0000:00:14.0-2": controller and port.
  std::string serial;      ///< Of the USB device; empty: it has none.
  double link_mbit_s = 0;  ///< What the USB link carries; 0: it is none.

  /// What tells the camera from others when it comes back under another number.
  const std::string& identity() const { return serial.empty() ? bus : serial; }
  /// What its bandwidth is shared on: the bus without the port.
  std::string controller() const;
};

/// Lists all nodes that give pictures; those for metadata, output or codecs are left out.
std::vector<V4l2Node> FindV4l2Nodes(VideoKernel& kernel, const DeviceTree& tree = {});

/// Finds the camera that a path (/dev/video0, a link in /dev/v4l), a bus or a serial number means.
/// @throws SetupError  when there is none, when there are several, or when it gives no pictures.
V4l2Node FindV4l2Node(VideoKernel& kernel, const std::string& name, const DeviceTree& tree = {});

/// Lists the cameras with their formats.
std::vector<ListedCamera> ListV4l2Cameras(VideoKernel& kernel, const DeviceTree& tree = {});

}  // namespace mocap
