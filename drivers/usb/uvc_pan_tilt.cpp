#include "drivers/usb/uvc_pan_tilt.h"

#include <libusb.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/errors.h"
#include "drivers/usb/uvc_heads.h"

namespace mocap {
namespace {

enum UvcRequest : std::uint8_t { kSetCur = 0x01, kGetCur = 0x81, kGetMin = 0x82, kGetMax = 0x83 };
constexpr std::uint16_t kPanTiltAbsolute = 0x0d << 8;
constexpr std::uint8_t kToInterface =
    std::uint8_t{LIBUSB_REQUEST_TYPE_CLASS} | std::uint8_t{LIBUSB_RECIPIENT_INTERFACE};
/// Cameras answer within a few milliseconds. One that hangs must not delay its frames for long.
constexpr unsigned kPatience_ms = 100;

/// Message with pan and tilt: two 32-bit integers, little-endian.
using Message = std::array<std::uint8_t, 8>;

double AngleAt(const Message& message, std::size_t at) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i) bits |= std::uint32_t{message[at + i]} << (8 * i);
  return static_cast<std::int32_t>(bits) * kArcSecond_rad;
}

void PutAngle(double angle_rad, Message& message, std::size_t at) {
  const auto bits = static_cast<std::uint32_t>(std::lround(angle_rad / kArcSecond_rad));
  for (std::size_t i = 0; i < 4; ++i) message[at + i] = static_cast<std::uint8_t>(bits >> (8 * i));
}

int Transfer(libusb_device_handle* handle, const UvcTerminal& terminal, UvcRequest what,
             Message& message) {
  const std::uint8_t direction = what == kSetCur ? LIBUSB_ENDPOINT_OUT : LIBUSB_ENDPOINT_IN;
  const auto whom = static_cast<std::uint16_t>(terminal.id << 8 | terminal.interface);
  return libusb_control_transfer(handle, direction | kToInterface, what, kPanTiltAbsolute, whom,
                                 message.data(), message.size(), kPatience_ms);
}

[[noreturn]] void Refuse(const UvcHead& head, int error) {
  throw SetupError(
      head.usb.bus + ": the head cannot be opened: " + libusb_strerror(error) +
      (error == LIBUSB_ERROR_ACCESS ? "; usually the user has to be in the group video" : ""));
}

/// Opens the device and detaches the kernel's driver until it is closed.
std::shared_ptr<libusb_device_handle> Open(const UvcHead& head) {
  libusb_device_handle* opened = nullptr;
  int error = libusb_open(head.usb.device.get(), &opened);
  if (error != LIBUSB_SUCCESS) Refuse(head, error);
  std::shared_ptr<libusb_device_handle> handle(opened, libusb_close);
  libusb_set_auto_detach_kernel_driver(opened, 1);
  error = libusb_claim_interface(opened, head.terminal.interface);
  if (error != LIBUSB_SUCCESS) Refuse(head, error);
  return {opened, [handle, interface = head.terminal.interface](libusb_device_handle* h) {
            libusb_release_interface(h, interface);
          }};
}

}  // namespace

UvcPanTilt::UvcPanTilt(std::string device, std::chrono::nanoseconds delay)
    : PolledPanTilt(std::move(device), delay) {}

UvcPanTilt::~UvcPanTilt() { Stop(); }

PanTiltLimits UvcPanTilt::Connect() {
  if (!bus_) bus_ = std::make_unique<UsbBus>();
  const UvcHead head = FindUvcHead(*bus_, device());
  terminal_ = head.terminal;
  handle_ = Open(head);
  const auto least = Request(kGetMin), most = Request(kGetMax);
  if (least && most) return {*least, *most};
  Disconnect();
  throw SetupError(head.usb.bus + ": does not report the range of its head");
}

void UvcPanTilt::Disconnect() { handle_.reset(); }

std::optional<PanTiltAngles> UvcPanTilt::Request(std::uint8_t what) {
  Message message{};
  const int bytes = Transfer(handle_.get(), terminal_, static_cast<UvcRequest>(what), message);
  if (bytes != static_cast<int>(message.size())) return std::nullopt;
  return PanTiltAngles{AngleAt(message, 0), AngleAt(message, 4)};
}

std::optional<PanTiltAngles> UvcPanTilt::Ask() { return Request(kGetCur); }

bool UvcPanTilt::Send(const PanTiltAngles& angles) {
  Message message{};
  PutAngle(angles.pan_rad, message, 0);
  PutAngle(angles.tilt_rad, message, 4);
  return Transfer(handle_.get(), terminal_, kSetCur, message) == static_cast<int>(message.size());
}

}  // namespace mocap
