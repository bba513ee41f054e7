// USB devices and hotplug, through libusb.
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

/// A USB device while it is connected.
struct UsbDevice {
  std::shared_ptr<libusb_device> device;
  std::string port;        ///< As "1-2.3": bus and ports, as the kernel names it.
  std::string bus;         ///< As "usb-0000:00:14.0-2.3", as in V4L2: controller and ports.
  std::string model;       ///< Empty if it reports none.
  std::string serial;      ///< Empty if it reports none.
  double link_mbit_s = 0;  ///< 0: unknown.

  /// The controller, whose bandwidth is shared: the bus without the ports.
  std::string controller() const { return bus.substr(0, bus.rfind('-')); }
};

/// Thread-bound.
class UsbBus {
 public:
  /// @param sys  the kernel's device folder (sysfs).
  /// @throws SetupError  when libusb cannot be used.
  explicit UsbBus(std::filesystem::path sys = "/sys");

  std::vector<UsbDevice> Devices() const;
  /// Whether a device came or went since the last call. Waits up to `patience` for one.
  bool HasChanged(std::chrono::milliseconds patience = {});

 private:
  const std::filesystem::path sys_;
  const std::unique_ptr<bool> changed_ = std::make_unique<bool>(false);
  std::shared_ptr<libusb_context> context_;
};

/// Finds the only device with a serial number; empty also if USB is not accessible.
std::optional<UsbDevice> FindUsbDevice(const std::string& serial);

}  // namespace mocap
