// The UVC terminal that turns a USB camera (USB Video Class 1.5, Camera Terminal).
#pragma once

#include <cstdint>
#include <optional>

struct libusb_device;

namespace mocap {

/// Destination of pan and tilt requests.
struct UvcTerminal {
  std::uint8_t configuration = 0;  ///< Of the device.
  std::uint8_t interface = 0;      ///< The video control interface.
  std::uint8_t id = 0;             ///< Within the interface.
};

/// Finds the terminal that pans and tilts a device to absolute angles. Reads only the descriptors.
std::optional<UvcTerminal> FindPanTiltTerminal(libusb_device* device);

}  // namespace mocap
