// Which GigE Vision and USB3 Vision cameras there are, and which of them a name means.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "drivers/camera_listing.h"

namespace mocap {

/// To be held while Aravis lists or opens devices: its list, and what its XML parser knows of
/// documents, are the process's and unguarded.
std::mutex& AravisMutex();

/// Looks for cameras on every network and USB; takes a second.
std::vector<ListedCamera> ListAravisCameras();

/// How to reach a camera.
struct AravisTarget {
  std::string device;  ///< As a person named it.
  std::string id;      ///< What Aravis opens it by.
  std::string ip;      ///< Of a GigE Vision camera; empty: it is none.
  std::string serial;  ///< Empty: not known yet.
};

/// Finds the camera that a name, serial number, MAC or IP address means.
/// @throws SetupError  when there is none, or more than one.
AravisTarget FindAravisCamera(const std::string& device);

}  // namespace mocap
