// Pan-tilt heads on USB, found by name.
#pragma once

#include <string>
#include <vector>

#include "drivers/usb/usb_bus.h"
#include "drivers/usb/uvc_terminal.h"

namespace mocap {

/// A USB device that can pan and tilt.
struct UvcHead {
  UsbDevice usb;
  UvcTerminal terminal;
};

std::vector<UvcHead> FindUvcHeads(const UsbBus& bus);

/// Finds the head with a serial number, a port ("1-2.3") or a bus ("usb-0000:00:14.0-2.3").
/// @throws SetupError  when there is none, or more than one.
UvcHead FindUvcHead(const UsbBus& bus, const std::string& name);

}  // namespace mocap
