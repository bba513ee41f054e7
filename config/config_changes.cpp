#include "config/config_changes.h"

#include <toml++/toml.h>

#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "config/toml_section.h"
#include "core/errors.h"

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
  TomlSection::ReadText(text, "configuration");  // Complains as everywhere.
  FlatTable flat;
  Flatten(toml::parse(text), "", flat);
  return flat;
}

}  // namespace

std::string ReadConfigText(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw SetupError(file.string() + ": cannot be read; a TOML file is wanted");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

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
