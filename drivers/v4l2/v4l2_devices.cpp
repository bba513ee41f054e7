#include "drivers/v4l2/v4l2_devices.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <system_error>
#include <utility>

#include "core/errors.h"
#include "drivers/quoted.h"
#include "drivers/v4l2/v4l2_format.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

std::string ReadLine(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

/// Finds a node's USB device: the nearest parent folder with a vendor.
std::optional<fs::path> UsbDeviceOf(const DeviceTree& tree, const std::string& node) {
  std::error_code error;
  fs::path folder = fs::canonical(tree.sys / "class/video4linux" / node / "device", error);
  if (error) return std::nullopt;
  for (; folder.has_relative_path(); folder = folder.parent_path()) {
    if (fs::exists(folder / "idVendor", error)) return folder;
  }
  return std::nullopt;
}

template <std::size_t kSize>
std::string Text(const unsigned char (&field)[kSize]) {
  const auto* end = std::find(field, field + kSize, 0);
  return Printable(std::string(field, end));
}

/// Queries a node. Empty: it delivers no pictures, or is gone.
std::optional<V4l2Node> Inspect(VideoKernel& kernel, const DeviceTree& tree,
                                const std::string& name) {
  const std::string path = (tree.dev / name).string();
  const int handle = kernel.Open(path);
  if (handle < 0) return std::nullopt;
  v4l2_capability capability{};
  const int result = kernel.Request(handle, VIDIOC_QUERYCAP, &capability);
  kernel.Close(handle);
  const std::uint32_t can = capability.capabilities & V4L2_CAP_DEVICE_CAPS
                                ? capability.device_caps
                                : capability.capabilities;
  constexpr std::uint32_t kWanted = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  if (result < 0 || (can & kWanted) != kWanted) return std::nullopt;
  V4l2Node node;
  node.path = path;
  node.model = Text(capability.card);
  node.kernel_driver = Text(capability.driver);
  node.bus = Text(capability.bus_info);
  if (const auto device = UsbDeviceOf(tree, name)) {
    node.serial = Printable(ReadLine(*device / "serial"));
    node.link_mbit_s = std::strtod(ReadLine(*device / "speed").c_str(), nullptr);
  }
  return node;
}

/// All video nodes in numeric order.
std::vector<std::string> NodeNames(const DeviceTree& tree) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(tree.sys / "class/video4linux", error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("video")) names.push_back(name);
  }
  std::ranges::sort(names, [](const std::string& a, const std::string& b) {
    return std::pair(a.size(), a) < std::pair(b.size(), b);
  });
  return names;
}

std::string Known(const std::vector<V4l2Node>& nodes) {
  if (nodes.empty()) return "no camera is connected";
  std::string text = "there is ";
  for (const V4l2Node& node : nodes) {
    text += (&node == &nodes.front() ? "" : ", ") + node.path + " (" + node.model + ", " +
            node.identity() + ")";
  }
  return text;
}

/// If several devices claim a link, udev gives it to one of them.
bool IsClaimedBySeveral(const DeviceTree& tree, const fs::path& link) {
  std::string escaped;
  for (const char c : link.lexically_relative(tree.dev).string()) {
    escaped += c == '/' ? "\\x2f" : c == '\\' ? "\\x5c" : std::string(1, c);
  }
  std::error_code error;
  const fs::directory_iterator claims(tree.udev_links / escaped, error);
  return !error && std::distance(begin(claims), end(claims)) > 1;
}

V4l2Node FindByPath(VideoKernel& kernel, const std::string& name, const DeviceTree& tree) {
  std::error_code error;
  const fs::path target = fs::canonical(name, error);
  if (error) throw SetupError(name + ": does not exist; " + Known(FindV4l2Nodes(kernel, tree)));
  if (IsClaimedBySeveral(tree, name)) {
    throw SetupError(name + ": matches several cameras; use their /dev/v4l/by-path or bus");
  }
  // A node without permission is reported differently from one without pictures.
  const int handle = kernel.Open(target.string());
  if (handle == -EACCES) {
    throw SetupError(name + ": permission denied; usually the user has to be in the group `video`");
  }
  if (handle >= 0) kernel.Close(handle);
  const auto node = Inspect(kernel, tree, target.filename().string());
  if (!node) {
    throw SetupError(name + ": delivers no pictures (cameras also have nodes for other data); " +
                     Known(FindV4l2Nodes(kernel, tree)));
  }
  return *node;
}

/// Returns the link in a folder that points to a node.
std::string LinkTo(const fs::path& folder, const std::string& node) {
  std::error_code error;
  for (const auto& link : fs::directory_iterator(folder, error)) {
    if (fs::canonical(link.path(), error) == fs::path(node)) return link.path().string();
  }
  return "";
}

/// Returns the name that stays valid longest: by serial number, else by socket, else by bus.
std::string BestName(const V4l2Node& node, const std::vector<V4l2Node>& all,
                     const DeviceTree& tree) {
  for (const char* folder : {"v4l/by-id", "v4l/by-path"}) {
    const std::string link = LinkTo(tree.dev / folder, node.path);
    if (!link.empty() && !IsClaimedBySeveral(tree, link)) return link;
  }
  const auto same_bus = std::ranges::count(all, node.bus, &V4l2Node::bus);
  return same_bus == 1 ? node.bus : node.path;
}

}  // namespace

std::string V4l2Node::controller() const {
  const bool is_usb = bus.starts_with("usb-");
  return is_usb ? bus.substr(0, bus.rfind('-')) : bus;
}

std::vector<V4l2Node> FindV4l2Nodes(VideoKernel& kernel, const DeviceTree& tree) {
  std::vector<V4l2Node> nodes;
  for (const std::string& name : NodeNames(tree)) {
    if (auto node = Inspect(kernel, tree, name)) nodes.push_back(std::move(*node));
  }
  return nodes;
}

V4l2Node FindV4l2Node(VideoKernel& kernel, const std::string& name, const DeviceTree& tree) {
  if (name.starts_with('/')) return FindByPath(kernel, name, tree);
  std::vector<V4l2Node> found;
  const std::vector<V4l2Node> all = FindV4l2Nodes(kernel, tree);
  for (const V4l2Node& node : all) {
    if (node.serial == name || node.bus == name) found.push_back(node);
  }
  if (found.empty()) {
    throw SetupError(name + ": no camera has this bus or serial number; " + Known(all));
  }
  if (found.size() > 1) {
    throw SetupError(name + ": matches several cameras; " + Known(found));
  }
  return found.front();
}

std::vector<ListedCamera> ListV4l2Cameras(VideoKernel& kernel, const DeviceTree& tree) {
  std::vector<ListedCamera> cameras;
  const std::vector<V4l2Node> nodes = FindV4l2Nodes(kernel, tree);
  for (const V4l2Node& node : nodes) {
    ListedCamera& camera = cameras.emplace_back();
    camera.driver = "v4l2";
    camera.device = BestName(node, nodes, tree);
    camera.model = node.model;
    camera.serial = node.serial;
    camera.bus = node.bus;
    camera.link_mbit_s = node.link_mbit_s;
    const int handle = kernel.Open(node.path);
    if (handle < 0) continue;
    camera.formats = DescribeFormats(kernel, handle);
    kernel.Close(handle);
  }
  return cameras;
}

}  // namespace mocap
