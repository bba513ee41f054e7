// The part of a USB camera that turns it (USB Video Class 1.5, Camera Terminal).
#pragma once

#include <cstdint>
#include <optional>

struct libusb_device;

namespace mocap {

/// Where requests to pan and tilt go.
struct UvcTerminal {
  std::uint8_t configuration = 0;  ///< Of the device.
  std::uint8_t interface = 0;      ///< For video control.
  std::uint8_t id = 0;             ///< Within the interface.
};

/// Finds the terminal of a device that pans and tilts to absolute angles, by its descriptors alone.
std::optional<UvcTerminal> FindPanTiltTerminal(libusb_device* device);

}  // namespace mocap
