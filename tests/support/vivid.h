// Linux's own test cameras, which a virtual machine has (tools/check_vm).
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <string>
#include <vector>

#include "drivers/v4l2/v4l2_devices.h"

namespace mocap::testing {

/// Those of vivid that may be used; none outside of the virtual machine.
inline std::vector<V4l2Node> VividNodes() {
  if (!std::getenv("MOCAP_IN_VM")) return {};
  const auto kernel = SystemVideoKernel();
  std::vector<V4l2Node> nodes = FindV4l2Nodes(*kernel);
  std::erase_if(nodes, [](const V4l2Node& node) { return node.kernel_driver != "vivid"; });
  return nodes;
}

/// Why tests with two of them are to be skipped; empty: they are not.
inline std::string WhyNoVivid() {
  return VividNodes().size() >= 2 ? "" : "needs vivid's cameras; tools/check --vm has them";
}

/// Sets a control by its name, as another program would.
inline void SetControl(const V4l2Node& node, const std::string& name, int value) {
  const int handle = open(node.path.c_str(), O_RDWR | O_NONBLOCK);
  ASSERT_GE(handle, 0) << node.path;
  v4l2_queryctrl query{};
  query.id = V4L2_CTRL_FLAG_NEXT_CTRL;
  bool found = false;
  while (!found && ioctl(handle, VIDIOC_QUERYCTRL, &query) == 0) {
    found = name == std::string(std::begin(query.name),
                                std::find(std::begin(query.name), std::end(query.name), 0));
    if (found) break;
    query.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
  }
  EXPECT_TRUE(found) << name;
  v4l2_control control{query.id, value};
  EXPECT_EQ(ioctl(handle, VIDIOC_S_CTRL, &control), 0) << name;
  close(handle);
}

}  // namespace mocap::testing
