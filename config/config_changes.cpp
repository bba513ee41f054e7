#include "config/config_changes.h"

#include <map>
#include <sstream>

#include "config/parse_toml.h"

namespace mocap {
namespace {

using FlatTable = std::map<std::string, std::string>;

void Flatten(const toml::table& table, const std::string& path, FlatTable& flat) {
  for (const auto& [key, node] : table) {
    const std::string name = path + std::string(key.str());
    if (const auto* inner = node.as_table()) {
      Flatten(*inner, name + '.', flat);
    } else {
      std::ostringstream text;
      node.visit([&text](const auto& value) { text << value; });
      flat[name] = text.str();
    }
  }
}

FlatTable FlatTableOf(const std::string& text) {
  FlatTable flat;
  Flatten(ParseToml(text, "configuration"), "", flat);
  return flat;
}

}  // namespace

std::string ReadConfigText(const std::filesystem::path& file) { return ReadTomlText(file); }

std::vector<std::string> ChangedKeys(const std::string& before, const std::string& after) {
  const FlatTable old_values = FlatTableOf(before);
  const FlatTable new_values = FlatTableOf(after);
  std::map<std::string, bool> changed;
  for (const auto& [key, value] : old_values) {
    const auto now = new_values.find(key);
    if (now == new_values.end() || now->second != value) changed[key] = true;
  }
  for (const auto& [key, value] : new_values) {
    if (!old_values.contains(key)) changed[key] = true;
  }
  std::vector<std::string> keys;
  for (const auto& [key, yes] : changed) keys.push_back(key);
  return keys;
}

}  // namespace mocap
