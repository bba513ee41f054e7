// Pan-tilt heads controlled by USB Video Class requests.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "drivers/polled_pan_tilt.h"
#include "drivers/usb/usb_bus.h"
#include "drivers/usb/uvc_terminal.h"

struct libusb_device_handle;

namespace mocap {

/// Reads and sets CT_PANTILT_ABSOLUTE_CONTROL (USB Video Class 1.5), for cameras whose pictures
/// come by network, SDI or HDMI. The kernel's driver is detached meanwhile and attached again at
/// the end. For cameras that stream through V4L2, use V4l2PanTilt.
class UvcPanTilt : public PolledPanTilt {
 public:
  /// @param device  serial number, port or bus of the USB device.
  /// @param delay   lag of a reading behind the head.
  UvcPanTilt(std::string device, std::chrono::nanoseconds delay);
  ~UvcPanTilt() override;

 private:
  PanTiltLimits Connect() override;
  void Disconnect() override;
  std::optional<PanTiltAngles> Ask() override;
  bool Send(const PanTiltAngles& angles) override;
  bool MayHaveReturned() override { return bus_ && bus_->HasChanged(); }

  std::optional<PanTiltAngles> Request(std::uint8_t what);

  std::unique_ptr<UsbBus> bus_;
  UvcTerminal terminal_;
  std::shared_ptr<libusb_device_handle> handle_;
};

}  // namespace mocap
