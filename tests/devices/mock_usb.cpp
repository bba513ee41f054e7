#include "tests/support/mock_usb.h"

#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include "core/errors.h"

namespace mocap::testing {
namespace {

constexpr std::uint8_t kTerminal = 1;
const std::string kController = "/devices/pci0000:00/0000:00:14.0/usb1";

std::string Hex(const std::vector<std::uint8_t>& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += "0123456789ABCDEF"[byte >> 4];
    text += "0123456789ABCDEF"[byte & 15];
  }
  return text;
}

/// Device, configuration, interfaces for control and pictures (USB Video Class 1.1).
std::vector<std::uint8_t> CameraDescriptors(bool pans) {
  const std::uint8_t controls = pans ? 0x0a : 0x02;  // Zoom, and perhaps pan and tilt.
  return {18, 1,    0,        2,         0xef, 2,    1,  64,   0xfe, 0xca, 0x0d, 0xf0, 0,   1,
          0,  2,    3,        1,         9,    2,    78, 0,    2,    1,    0,    0x80, 250,  //
          8,  11,   0,        2,         14,   3,    0,  0,                                  //
          9,  4,    0,        0,         0,    14,   1,  0,    0,                            //
          13, 0x24, 1,        0x10,      1,    0x34, 0,  0x80, 0x8d, 0x5b, 0,    1,    1,    //
          18, 0x24, 2,        kTerminal, 1,    2,    0,  0,    0,    0,    0,    0,    0,   0,
          3,  0,    controls, 0,                                   //
          9,  0x24, 3,        2,         1,    1,    0,  1,    0,  //
          9,  4,    1,        0,         0,    14,   2,  0,    0,  //
          3,  0x24, 0};
}

std::string UsbNode(const std::string& path, int number, const std::string& attributes) {
  const std::string node = "bus/usb/001/00" + std::to_string(number);
  return "P: " + path + "\nN: " + node + "\nE: DEVNAME=/dev/" + node +
         "\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nE: BUSNUM=001\nE: DEVNUM=00" +
         std::to_string(number) + "\nE: MAJOR=189\nE: MINOR=" + std::to_string(number - 1) +
         "\nA: busnum=1\\n\nA: devnum=" + std::to_string(number) +
         "\\n\nA: speed=480\\n\nA: bConfigurationValue=1\\n\n" + attributes;
}

}  // namespace

MockHead::Angles MockHead::angles() const {
  const std::lock_guard lock(mutex_);
  return angles_;
}

void MockHead::Point(const Angles& angles) {
  const std::lock_guard lock(mutex_);
  angles_ = angles;
}

void MockHead::FallSilent() {
  const std::lock_guard lock(mutex_);
  is_silent_ = true;
}

bool MockHead::kernel_has_it() const {
  const std::lock_guard lock(mutex_);
  return kernel_has_it_;
}

void MockHead::Unplug() {
  const std::lock_guard lock(mutex_);
  is_gone_ = true;
}

/// Answers the one control that there is; @return  bytes that went, or an error.
int MockHead::Answer(std::uint8_t* setup) {
  enum : std::uint8_t { kSetCur = 0x01, kGetCur = 0x81, kGetMin = 0x82, kGetMax = 0x83 };
  std::uint8_t* message = setup + 8;
  const bool is_ours = setup[3] == 0x0d && setup[5] == kTerminal && setup[6] == sizeof(Angles);
  if (is_silent_ || !is_ours) return -EPIPE;
  if (setup[1] == kSetCur) {
    Angles wanted;
    std::memcpy(&wanted, message, sizeof wanted);
    if (wanted.pan < least.pan || wanted.pan > most.pan) return -EPIPE;
    if (wanted.tilt < least.tilt || wanted.tilt > most.tilt) return -EPIPE;
    angles_ = wanted;
    return sizeof wanted;
  }
  const Angles* told = setup[1] == kGetCur   ? &angles_
                       : setup[1] == kGetMin ? &least
                       : setup[1] == kGetMax ? &most
                                             : nullptr;
  if (!told) return -EPIPE;
  std::memcpy(message, told, sizeof *told);
  return sizeof *told;
}

/// @return  what ioctl gives: 0 or an error.
int MockHead::Submit(UMockdevIoctlData* data) {
  auto* urb = reinterpret_cast<usbdevfs_urb*>(data->data);
  if (urb->type != USBDEVFS_URB_TYPE_CONTROL) return EINVAL;
  if (is_gone_) return ENODEV;
  // As the kernel: who has not claimed an interface may not talk to it while a driver has it.
  if (kernel_has_it_ && !is_claimed_) return EBUSY;
  const GPtr<UMockdevIoctlData> buffer(umockdev_ioctl_data_resolve(
      data, offsetof(usbdevfs_urb, buffer), static_cast<gsize>(urb->buffer_length), nullptr));
  const int went = Answer(buffer->data);
  urb->status = went < 0 ? went : 0;
  urb->actual_length = went < 0 ? 0 : went;
  answered_.reset(static_cast<UMockdevIoctlData*>(g_object_ref(data)));
  return 0;
}

void MockHead::Handle(UMockdevIoctlClient* client) {
  const gulong request = umockdev_ioctl_client_get_request(client);
  const gsize size = _IOC_SIZE(request);
  UMockdevIoctlData* argument = umockdev_ioctl_client_get_arg(client);
  const GPtr<UMockdevIoctlData> data(size ? umockdev_ioctl_data_resolve(argument, 0, size, nullptr)
                                          : nullptr);
  int error = 0;
  switch (request) {
    case USBDEVFS_GET_CAPABILITIES:
      *reinterpret_cast<std::uint32_t*>(data->data) = USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      break;
    case USBDEVFS_IOCTL: {
      const int code = reinterpret_cast<usbdevfs_ioctl*>(data->data)->ioctl_code;
      kernel_has_it_ = code == static_cast<int>(USBDEVFS_CONNECT);
      break;
    }
    case USBDEVFS_GETDRIVER:
      std::strcpy(reinterpret_cast<usbdevfs_getdriver*>(data->data)->driver, "uvcvideo");
      error = kernel_has_it_ ? 0 : ENODATA;
      break;
    case USBDEVFS_CLAIMINTERFACE:
      error = kernel_has_it_ ? EBUSY : 0;
      is_claimed_ = error == 0;
      break;
    case USBDEVFS_RELEASEINTERFACE:
      is_claimed_ = false;
      break;
    case USBDEVFS_SUBMITURB:
      error = Submit(data.get());
      break;
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY:
      error = answered_ ? 0 : EAGAIN;
      if (answered_) umockdev_ioctl_data_set_ptr(data.get(), 0, answered_.release());
      break;
    default:
      error = ENOTTY;
  }
  umockdev_ioctl_client_complete(client, error ? -1 : 0, error);
}

gboolean MockHead::OnIoctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  auto* head = static_cast<MockHead*>(self);
  const std::lock_guard lock(head->mutex_);
  head->Handle(client);
  return TRUE;
}

MockUsb::MockUsb() : testbed_(umockdev_testbed_new()) {
  MOCAP_CHECK(umockdev_in_mock_environment());
  // The controller's own hub.
  Add(UsbNode(kController, 1,
              "H: descriptors=" + Hex({18, 1, 0, 2, 9, 0, 1, 64, 0x6b, 0x1d, 2, 0,    0, 1,
                                       0,  0, 0, 1, 9, 2, 9, 0,  0,    1,    0, 0x80, 0}) +
                  "\n"));
}

void MockUsb::Add(const std::string& description) {
  GFailure failure;
  umockdev_testbed_add_from_string(testbed_.get(), description.c_str(), failure);
  MOCAP_CHECK(!failure.failed());
}

void MockUsb::Plug(int port, const std::string& serial, MockHead& head, bool pans) {
  const int number = port + 1;
  Add(UsbNode(kController + "/1-" + std::to_string(port), number,
              "A: product=PTZ camera\\n\n" +
                  (serial.empty() ? "" : "A: serial=" + serial + "\\n\n") +
                  "H: descriptors=" + Hex(CameraDescriptors(pans)) + "\n"));
  head.ioctls_.reset(umockdev_ioctl_base_new());
  g_signal_connect(head.ioctls_.get(), "handle-ioctl", G_CALLBACK(&MockHead::OnIoctl), &head);
  const std::string node = "/dev/bus/usb/001/00" + std::to_string(number);
  GFailure failure;
  umockdev_testbed_attach_ioctl(testbed_.get(), node.c_str(), head.ioctls_.get(), failure);
  MOCAP_CHECK(!failure.failed());
}

void MockUsb::Unplug(int port, MockHead& head) {
  head.Unplug();
  const std::string path = "/sys" + kController + "/1-" + std::to_string(port);
  umockdev_testbed_uevent(testbed_.get(), path.c_str(), "remove");
  umockdev_testbed_remove_device(testbed_.get(), path.c_str());
}

}  // namespace mocap::testing
