#include "tools/calibration/xml_tags.h"

#include <algorithm>
#include <sstream>

#include "core/errors.h"
#include "drivers/quoted.h"
#include "tools/calibration/data_tree.h"
#include "tools/calibration/foreign_camera.h"

namespace mocap {
namespace {

constexpr const char* kBlanks = " \t\r\n";

XmlTag ParseTag(const std::string& text, int line) {
  XmlTag tag;
  tag.line = line;
  const std::size_t name_end = std::min(text.find_first_of(" \t\r\n", 1), text.size());
  tag.name = text.substr(0, name_end);
  std::size_t at = name_end;
  for (;;) {
    const std::size_t key = text.find_first_not_of(kBlanks, at);
    const std::size_t equals = text.find('=', std::min(key, text.size()));
    if (key == std::string::npos || equals == std::string::npos) return tag;
    const std::size_t open = text.find_first_of("\"'", equals);
    if (open == std::string::npos) return tag;
    const std::size_t close = text.find(text[open], open + 1);
    if (close == std::string::npos) return tag;
    const std::size_t key_end = text.find_last_not_of(kBlanks, equals - 1) + 1;
    tag.attributes[text.substr(key, key_end - key)] = text.substr(open + 1, close - open - 1);
    at = close + 1;
  }
}

}  // namespace

std::vector<XmlTag> ReadXmlTags(const std::filesystem::path& file) {
  const std::string text = ReadForeignText(file);
  const std::string name = Printable(file.string());
  std::vector<XmlTag> tags;
  int line = 1;
  std::size_t at = 0;
  for (;;) {
    const std::size_t open = text.find('<', at);
    const std::size_t text_end = std::min(open, text.size());
    if (!tags.empty()) tags.back().text += text.substr(at, text_end - at);
    if (open == std::string::npos) break;
    const bool comment = text.compare(open, 4, "<!--") == 0;
    line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                                        text.begin() + static_cast<std::ptrdiff_t>(open), '\n'));
    const std::size_t close = comment ? text.find("-->", open) : text.find('>', open);
    if (close == std::string::npos)
      throw SetupError(name + ":" + std::to_string(line) + ": a tag does not end");
    std::string inside = text.substr(open + 1, close - open - 1);
    const bool is_empty = !inside.empty() && inside.back() == '/';
    if (is_empty) inside.pop_back();
    if (!inside.empty() && inside[0] != '!' && inside[0] != '?') {
      tags.push_back(ParseTag(inside, line));
      tags.back().is_empty = is_empty;
    }
    line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(open),
                                        text.begin() + static_cast<std::ptrdiff_t>(close), '\n'));
    at = close + (comment ? 3 : 1);
  }
  if (tags.empty()) throw SetupError(name + ": is not XML; expected a calibration");
  return tags;
}

std::vector<double> XmlNumbers(const XmlTag& tag, const std::string& key, std::size_t count,
                               const std::filesystem::path& file) {
  const std::string where = Printable(file.string()) + ":" + std::to_string(tag.line) + ": " +
                            Printable(tag.name) + "." + key;
  if (!tag.Has(key)) throw SetupError(where + " is missing");
  std::istringstream in(tag.attributes.at(key));
  std::vector<double> numbers;
  for (std::string word; in >> word;) numbers.push_back(FiniteNumber(word, where));
  if (numbers.size() < count)
    throw SetupError(where + " has fewer than " + std::to_string(count) + " numbers");
  return numbers;
}

}  // namespace mocap
