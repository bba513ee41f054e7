#include "drivers/usb/uvc_heads.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/errors.h"

namespace mocap {
namespace {

std::string Known(const std::vector<UvcHead>& heads) {
  if (heads.empty()) return "no connected USB device has a pan-tilt head";
  std::string text = "there is ";
  for (const UvcHead& head : heads) {
    text += (&head == &heads.front() ? "" : ", ") + head.usb.bus + " (" + head.usb.model +
            (head.usb.serial.empty() ? "" : ", " + head.usb.serial) + ")";
  }
  return text;
}

}  // namespace

std::vector<UvcHead> FindUvcHeads(const UsbBus& bus) {
  std::vector<UvcHead> heads;
  for (UsbDevice& device : bus.Devices()) {
    const auto terminal = FindPanTiltTerminal(device.device.get());
    if (terminal) heads.push_back({std::move(device), *terminal});
  }
  return heads;
}

UvcHead FindUvcHead(const UsbBus& bus, const std::string& name) {
  const std::vector<UvcHead> heads = FindUvcHeads(bus);
  std::vector<UvcHead> meant;
  std::ranges::copy_if(heads, std::back_inserter(meant), [&name](const UvcHead& head) {
    return head.usb.serial == name || head.usb.port == name || head.usb.bus == name;
  });
  if (meant.empty()) {
    throw SetupError(name + ": no head has this serial number, port or bus; " + Known(heads));
  }
  if (meant.size() > 1) throw SetupError(name + ": matches several heads; " + Known(meant));
  return meant.front();
}

}  // namespace mocap
