#include "drivers/usb/uvc_terminal.h"

#include <libusb.h>

#include <memory>
#include <span>

namespace mocap {
namespace {

constexpr std::uint8_t kVideoControl = 1;
constexpr std::uint8_t kClassInterface = 0x24, kInputTerminal = 0x02;
constexpr int kCamera = 0x0201;
/// Offsets in the descriptor of a camera terminal.
constexpr std::size_t kId = 3, kTypeLow = 4, kTypeHigh = 5, kControlSize = 14, kControls = 15;
/// PanTilt (Absolute): bit 11 of the controls.
constexpr std::size_t kPanTiltByte = 1;
constexpr std::uint8_t kPanTiltBit = 1 << 3;

bool PansAndTilts(std::span<const std::uint8_t> terminal) {
  return terminal.size() > kControls + kPanTiltByte && terminal[1] == kClassInterface &&
         terminal[2] == kInputTerminal &&
         (terminal[kTypeLow] | terminal[kTypeHigh] << 8) == kCamera &&
         terminal[kControlSize] > kPanTiltByte &&
         (terminal[kControls + kPanTiltByte] & kPanTiltBit) != 0;
}

/// Class descriptors follow each other; each begins with its length.
std::optional<std::uint8_t> FindTerminalId(std::span<const std::uint8_t> descriptors) {
  while (descriptors.size() >= 2 && descriptors[0] >= 2 && descriptors[0] <= descriptors.size()) {
    const auto descriptor = descriptors.first(descriptors[0]);
    if (PansAndTilts(descriptor)) return descriptor[kId];
    descriptors = descriptors.subspan(descriptor.size());
  }
  return std::nullopt;
}

}  // namespace

std::optional<UvcTerminal> FindPanTiltTerminal(libusb_device* device) {
  libusb_config_descriptor* active = nullptr;
  if (libusb_get_active_config_descriptor(device, &active) != LIBUSB_SUCCESS) return std::nullopt;
  const std::unique_ptr<libusb_config_descriptor, decltype(&libusb_free_config_descriptor)> config(
      active, libusb_free_config_descriptor);
  for (const libusb_interface& interface : std::span(config->interface, config->bNumInterfaces)) {
    if (interface.num_altsetting == 0) continue;
    const libusb_interface_descriptor& setting = interface.altsetting[0];
    if (setting.bInterfaceClass != LIBUSB_CLASS_VIDEO) continue;
    if (setting.bInterfaceSubClass != kVideoControl) continue;
    const std::span extra(setting.extra, static_cast<std::size_t>(setting.extra_length));
    if (const auto id = FindTerminalId(extra)) {
      return UvcTerminal{config->bConfigurationValue, setting.bInterfaceNumber, *id};
    }
  }
  return std::nullopt;
}

}  // namespace mocap
