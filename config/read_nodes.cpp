#include "config/read_nodes.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace mocap {
namespace {

constexpr std::size_t kLongestName = 16;

/// Names become part of channel names.
std::string ReadName(TomlSection& section) {
  const std::string name = section.Text("name");
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  if (name.empty() || name.size() > kLongestName || !std::ranges::all_of(name, fits)) {
    section.Fail("name", "is \"" + name + "\"; expected 1 to " + std::to_string(kLongestName) +
                             " letters, digits, _ and -");
  }
  return name;
}

NodeConfig ReadNode(TomlSection section) {
  NodeConfig node;
  node.name = ReadName(section);
  if (section.Has("cameras")) node.cameras = section.Texts("cameras");
  section.RejectUnknownKeys();
  return node;
}

StudioNode ReadStudioNode(TomlSection section, std::set<std::string>& names,
                          std::set<std::string>& cameras) {
  StudioNode node;
  node.name = ReadName(section);
  if (!names.insert(node.name).second) {
    section.Fail("name",
                 "is \"" + node.name + "\", the name of another node; expected a unique name");
  }
  node.cameras = section.Texts("cameras");
  if (node.cameras.empty()) section.Fail("cameras", "is empty; expected names of cameras");
  for (const std::string& camera : node.cameras) {
    if (cameras.insert(camera).second) continue;
    section.Fail("cameras", "has \"" + camera + "\" twice");
  }
  if (section.Has("control")) node.control = section.Texts("control");
  section.RejectUnknownKeys();
  return node;
}

}  // namespace

void ReadRole(TomlSection& root, Config& config) {
  config.role = static_cast<Role>(root.Choice("role", {"alone", "node", "studio"}, 0));
  if (auto section = root.Section("node")) {
    if (config.role != Role::kNode) root.Fail("node", "exists, but needs role = \"node\"");
    if (section->Has("cameras") && IsLive(config.source)) {
      section->Fail("cameras",
                    "is for takes and the simulated studio; [[cameras]] are the ones of "
                    "source.driver \"" +
                        config.source.driver + "\"");
    }
    config.node = ReadNode(std::move(*section));
  }
  std::set<std::string> names, cameras;
  for (const CameraConfig& camera : config.cameras) cameras.insert(camera.name);
  for (TomlSection& section : root.Sections("nodes"))
    config.nodes.push_back(ReadStudioNode(std::move(section), names, cameras));
  if (!config.nodes.empty() && config.role != Role::kStudio)
    root.Fail("nodes", "exists, but needs role = \"studio\"");
}

void CheckRole(const TomlSection& root, const Config& config) {
  if (config.role == Role::kNode && config.node.name.empty())
    root.Fail("node", "is missing; role \"node\" needs [node] with a name");
  if (config.role != Role::kStudio) return;
  if (config.nodes.empty()) root.Fail("nodes", "is missing; role \"studio\" needs it");
  if (config.calibration.empty())
    root.Fail("calibration", "is missing; role \"studio\" needs that of all cameras");
}

}  // namespace mocap
