// What is plugged into USB, and what comes and goes, by libusb.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct libusb_context;
struct libusb_device;

namespace mocap {

/// A USB device while it is plugged in.
struct UsbDevice {
  std::shared_ptr<libusb_device> device;
  std::string port;    ///< As "1-2.3": the bus and the ports on the way, as the kernel names it.
  std::string bus;     ///< As "usb-0000:00:14.0-2.3", as V4L2 names it: the controller, the ports.
  std::string model;   ///< Empty: it tells none.
  std::string serial;  ///< Likewise.
  double link_mbit_s = 0;  ///< 0: unknown.

  /// What its bandwidth is shared on: the bus without the ports.
  std::string controller() const { return bus.substr(0, bus.rfind('-')); }
};

/// Thread-bound.
class UsbBus {
 public:
  /// @param sys  where the kernel tells of devices.
  /// @throws SetupError  when libusb cannot be used.
  explicit UsbBus(std::filesystem::path sys = "/sys");

  std::vector<UsbDevice> Devices() const;
  /// Whether a device came or went since the last call; waits so long for one that does.
  bool HasChanged(std::chrono::milliseconds patience = {});

 private:
  const std::filesystem::path sys_;
  const std::unique_ptr<bool> changed_ = std::make_unique<bool>(false);
  std::shared_ptr<libusb_context> context_;
};

/// Finds the only device with a serial number; nothing as well where USB cannot be asked.
std::optional<UsbDevice> FindUsbDevice(const std::string& serial);

}  // namespace mocap
