// As much XML as calibration files need: the opening tags in order, with their attributes.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace mocap {

struct XmlTag {
  std::string name;  ///< With a slash before it, when it closes.
  std::map<std::string, std::string> attributes;
  int line = 0;

  bool Has(const std::string& key) const { return attributes.contains(key); }
};

/// Reads all tags. @throws SetupError  when the file cannot be read or a tag does not end.
std::vector<XmlTag> ReadXmlTags(const std::filesystem::path& file);

/// Reads an attribute's numbers, separated by blanks.
/// @throws SetupError  naming file, line and key, when it is missing or has fewer than `count`.
std::vector<double> XmlNumbers(const XmlTag& tag, const std::string& key, std::size_t count,
                               const std::filesystem::path& file);

}  // namespace mocap
