#include "drivers/usb/usb_bus.h"

#include <libusb.h>

#include <array>
#include <fstream>
#include <system_error>
#include <utility>

#include "core/errors.h"
#include "drivers/quoted.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

std::string ReadPrintable(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return Printable(line);
}

double LinkOf(libusb_device* device) {
  switch (libusb_get_device_speed(device)) {
    case LIBUSB_SPEED_LOW:
      return 1.5;
    case LIBUSB_SPEED_FULL:
      return 12;
    case LIBUSB_SPEED_HIGH:
      return 480;
    case LIBUSB_SPEED_SUPER:
      return 5000;
    case LIBUSB_SPEED_SUPER_PLUS:
      return 10000;
    default:
      return 0;
  }
}

/// Ports between the controller and a device, as "2.3"; empty for the root hub.
std::string PortsTo(libusb_device* device) {
  constexpr int kDeepest = 7;
  std::array<std::uint8_t, kDeepest> ports{};
  const int count = libusb_get_port_numbers(device, ports.data(), kDeepest);
  std::string text;
  for (int i = 0; i < count; ++i) {
    if (i > 0) text += '.';
    text += std::to_string(ports[i]);
  }
  return text;
}

/// Name of a bus's parent folder, as "0000:00:14.0".
std::string ControllerOf(const fs::path& buses, const std::string& bus) {
  std::error_code error;
  return fs::canonical(buses / ("usb" + bus), error).parent_path().filename().string();
}

int NoteChange(libusb_context*, libusb_device*, libusb_hotplug_event, void* changed) {
  *static_cast<bool*>(changed) = true;
  return 0;
}

}  // namespace

UsbBus::UsbBus(fs::path sys) : sys_(std::move(sys)) {
  libusb_context* context = nullptr;
  if (const int error = libusb_init(&context); error != LIBUSB_SUCCESS) {
    throw SetupError(std::string("USB cannot be used: ") + libusb_strerror(error));
  }
  context_ = {context, libusb_exit};
  const int error = libusb_hotplug_register_callback(
      context, LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT, 0,
      LIBUSB_HOTPLUG_MATCH_ANY, LIBUSB_HOTPLUG_MATCH_ANY, LIBUSB_HOTPLUG_MATCH_ANY, NoteChange,
      changed_.get(), nullptr);
  if (error != LIBUSB_SUCCESS) {
    throw SetupError(std::string("USB does not report when devices are plugged in or out: ") +
                     libusb_strerror(error));
  }
}

std::vector<UsbDevice> UsbBus::Devices() const {
  libusb_device** list = nullptr;
  const auto count = libusb_get_device_list(context_.get(), &list);
  const fs::path folders = sys_ / "bus/usb/devices";
  std::vector<UsbDevice> devices;
  for (decltype(+count) i = 0; i < count; ++i) {
    const std::string bus = std::to_string(libusb_get_bus_number(list[i]));
    const std::string ports = PortsTo(list[i]);
    UsbDevice& found = devices.emplace_back();
    // A device must be released before its context.
    found.device = {list[i], [context = context_](libusb_device* d) { libusb_unref_device(d); }};
    found.port = bus + '-' + ports;
    found.bus = "usb-" + ControllerOf(folders, bus) + '-' + ports;
    found.model = ReadPrintable(folders / found.port / "product");
    found.serial = ReadPrintable(folders / found.port / "serial");
    found.link_mbit_s = LinkOf(list[i]);
  }
  libusb_free_device_list(list, /*unref_devices=*/0);
  return devices;
}

bool UsbBus::HasChanged(std::chrono::milliseconds patience) {
  using std::chrono::microseconds;
  const auto patience_us = std::chrono::duration_cast<microseconds>(patience).count();
  timeval timeout{static_cast<time_t>(patience_us / 1'000'000),
                  static_cast<suseconds_t>(patience_us % 1'000'000)};
  libusb_handle_events_timeout_completed(context_.get(), &timeout, nullptr);
  return std::exchange(*changed_, false);
}

std::optional<UsbDevice> FindUsbDevice(const std::string& serial) {
  if (serial.empty()) return std::nullopt;
  try {
    std::vector<UsbDevice> devices = UsbBus().Devices();
    std::erase_if(devices, [&serial](const UsbDevice& d) { return d.serial != serial; });
    if (devices.size() == 1) return devices.front();
  } catch (const SetupError&) {
    // The bus stays unknown.
  }
  return std::nullopt;
}

}  // namespace mocap
