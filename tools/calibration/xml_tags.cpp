#include "tools/calibration/xml_tags.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

#include "core/errors.h"

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
  std::ifstream in(file, std::ios::binary);
  if (!in) throw SetupError(file.string() + ": cannot be read");
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  std::vector<XmlTag> tags;
  int line = 1;
  std::size_t at = 0;
  for (;;) {
    const std::size_t open = text.find('<', at);
    if (open == std::string::npos) break;
    line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                                        text.begin() + static_cast<std::ptrdiff_t>(open), '\n'));
    const bool comment = text.compare(open, 4, "<!--") == 0;
    const std::size_t close = comment ? text.find("-->", open) : text.find('>', open);
    if (close == std::string::npos)
      throw SetupError(file.string() + ":" + std::to_string(line) + ": a tag does not end");
    std::string inside = text.substr(open + 1, close - open - 1);
    if (!inside.empty() && inside.back() == '/') inside.pop_back();
    if (!inside.empty() && inside[0] != '!' && inside[0] != '?')
      tags.push_back(ParseTag(inside, line));
    at = open + 1;
    if (comment) at = close;
  }
  return tags;
}

std::vector<double> XmlNumbers(const XmlTag& tag, const std::string& key, std::size_t count,
                               const std::filesystem::path& file) {
  const auto fail = [&](const std::string& what) {
    throw SetupError(file.string() + ":" + std::to_string(tag.line) + ": " + tag.name + "." + key +
                     " " + what);
  };
  if (!tag.Has(key)) fail("is missing");
  std::istringstream in(tag.attributes.at(key));
  std::vector<double> numbers;
  for (std::string word; in >> word;) {
    char* end = nullptr;
    numbers.push_back(std::strtod(word.c_str(), &end));
    if (end == word.c_str() || *end != '\0') fail("holds \"" + word + "\", which is no number");
  }
  if (numbers.size() < count) fail("has fewer than " + std::to_string(count) + " numbers");
  return numbers;
}

}  // namespace mocap
