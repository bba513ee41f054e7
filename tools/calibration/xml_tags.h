// Minimal XML for calibration files: the opening tags in order, with their attributes.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace mocap {

struct XmlTag {
  std::string name;  ///< With a leading slash in closing tags.
  std::map<std::string, std::string> attributes;
  std::string text;       ///< Text up to the next tag.
  bool is_empty = false;  ///< Closes itself.
  int line = 0;

  bool Has(const std::string& key) const { return attributes.contains(key); }
};

/// Reads all tags. @throws SetupError  when the file cannot be read, is not XML, or a tag does not
/// end.
std::vector<XmlTag> ReadXmlTags(const std::filesystem::path& file);

/// Reads an attribute's numbers, separated by blanks.
/// @throws SetupError  naming file, line and key, when it is missing, has fewer than `count`, or
/// contains anything but finite numbers.
std::vector<double> XmlNumbers(const XmlTag& tag, const std::string& key, std::size_t count,
                               const std::filesystem::path& file);

}  // namespace mocap
