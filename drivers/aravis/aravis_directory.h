// GigE Vision and USB3 Vision cameras, found by name.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "drivers/camera_listing.h"

namespace mocap {

/// Lock it while Aravis lists or opens devices: its device list and its XML parser's documents are
/// global and unguarded.
std::mutex& AravisMutex();

/// Searches all networks and USB for cameras; takes a second.
std::vector<ListedCamera> ListAravisCameras();

/// How to reach a camera.
struct AravisTarget {
  std::string device;  ///< Name given by the user.
  std::string id;      ///< Identifier for Aravis.
  std::string ip;      ///< Of a GigE Vision camera; otherwise empty.
  std::string serial;  ///< Empty: not yet known.
};

/// Finds the camera with a name, serial number, MAC or IP address.
/// @throws SetupError  when there is none, or more than one.
AravisTarget FindAravisCamera(const std::string& device);

}  // namespace mocap
