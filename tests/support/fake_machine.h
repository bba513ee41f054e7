// A machine with V4L2 cameras, its kernel and its files.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "drivers/v4l2/v4l2_devices.h"
#include "drivers/v4l2/v4l2_driver.h"
#include "tests/support/fake_video_kernel.h"
#include "tests/support/temporary_folder.h"

namespace mocap::testing {

/// A machine with cameras: the kernel's part, and the files that tell of devices.
class FakeMachine {
 public:
  FakeMachine() {
    std::filesystem::create_directories(tree.dev / "v4l/by-id");
    std::filesystem::create_directories(tree.sys / "class/video4linux");
  }

  /// Plugs in a USB camera, as /dev/video<number>.
  FakeCamera& Plug(int number, const std::string& serial = "", const std::string& port = "1") {
    const std::string name = "video" + std::to_string(number);
    const std::filesystem::path usb = tree.sys / "devices" / ("usb-" + name);
    std::filesystem::create_directories(usb / "interface");
    WriteText(usb / "idVendor", "cafe\n");
    WriteText(usb / "speed", "480\n");
    if (!serial.empty()) WriteText(usb / "serial", serial + "\n");
    std::filesystem::create_directories(tree.sys / "class/video4linux" / name);
    std::filesystem::create_symlink(usb / "interface",
                                    tree.sys / "class/video4linux" / name / "device");
    WriteText(tree.dev / name, "");
    FakeCamera& camera = kernel->cameras[Node(number)];
    camera.bus = "usb-0000:00:14.0-" + port;
    return camera;
  }

  void Unplug(int number) {
    const std::string name = "video" + std::to_string(number);
    kernel->cameras.at(Node(number)).is_plugged_in = false;
    std::filesystem::remove_all(tree.sys / "class/video4linux" / name);
    std::filesystem::remove(tree.dev / name);
  }

  std::string Node(int number) const {
    return (tree.dev / ("video" + std::to_string(number))).string();
  }

  /// A link of udev, claimed by so many devices.
  std::string Link(const std::string& name, int number, int claims = 1) {
    const std::filesystem::path link = tree.dev / "v4l/by-id" / name;
    std::filesystem::remove(link);
    std::filesystem::create_symlink(tree.dev / ("video" + std::to_string(number)), link);
    const std::filesystem::path folder = tree.udev_links / ("v4l\\x2fby-id\\x2f" + name);
    std::filesystem::create_directories(folder);
    for (int i = 0; i < claims; ++i) WriteText(folder / ("c81:" + std::to_string(i)), "");
    return link.string();
  }

  V4l2Driver Driver(const std::string& device, const V4l2Settings& settings = {}) {
    return {{device, 64, 48, 30}, settings, kernel, tree};
  }

  TemporaryFolder root;
  DeviceTree tree{root.path() / "dev", root.path() / "sys", root.path() / "links"};
  std::shared_ptr<FakeVideoKernel> kernel = std::make_shared<FakeVideoKernel>();
};

}  // namespace mocap::testing
