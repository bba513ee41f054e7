#include "tools/calibration/data_tree.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "core/errors.h"
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "tools/calibration/foreign_camera.h"
#include "tools/calibration/xml_tags.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFile = 32 << 20;
constexpr std::size_t kDeepestElements = 16, kMostElements = 10'000, kMostWords = 2'000'000;

// For "<rows>3</rows>": one word is a text, several are a sequence.
void SetText(const std::string& text, std::size_t most_words, DataNode& node) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; words.size() < most_words && in >> word;) {
    const bool is_quoted = word.size() >= 2 && word.front() == '"' && word.back() == '"';
    words.push_back(is_quoted ? word.substr(1, word.size() - 2) : word);
  }
  if (words.size() == 1) {
    node.text = words[0];
  } else if (!words.empty()) {
    node.kind = DataNode::Kind::kSequence;
    for (const std::string& word : words) {
      node.items.emplace_back();
      node.items.back().text = word;
      node.items.back().line = node.line;
    }
  }
}

}  // namespace

const DataNode* DataNode::Find(std::string_view key) const {
  const auto place = std::find(keys.begin(), keys.end(), key);
  return place == keys.end() ? nullptr : &items[static_cast<std::size_t>(place - keys.begin())];
}

std::string DataFile::At(const DataNode& node) const {
  return Printable(path.string()) + ":" + std::to_string(node.line);
}

double DataFile::Number(const DataNode& node, const std::string& key) const {
  if (node.kind != DataNode::Kind::kText)
    throw SetupError(At(node) + ": " + Printable(key) + " is not a number, but a list or a table");
  return FiniteNumber(node.text, At(node) + ": " + Printable(key));
}

std::vector<double> DataFile::Numbers(const DataNode& node, const std::string& key) const {
  std::vector<double> numbers;
  if (node.kind == DataNode::Kind::kMapping) {
    const DataNode* data = node.Find("data");
    if (data == nullptr)
      throw SetupError(At(node) + ": " + Printable(key) +
                       " has no data; expected rows, cols and data");
    numbers = Numbers(*data, key + ".data");
    const DataNode *rows = node.Find("rows"), *cols = node.Find("cols");
    if (rows != nullptr && cols != nullptr &&
        Number(*rows, key + ".rows") * Number(*cols, key + ".cols") !=
            static_cast<double>(numbers.size()))
      throw SetupError(At(node) + ": " + Printable(key) + " has " + rows->text + " x " +
                       cols->text + " by its rows and cols, but " + std::to_string(numbers.size()) +
                       " numbers; the file may be cut off");
    return numbers;
  }
  if (node.kind == DataNode::Kind::kText) return {Number(node, key)};
  for (const DataNode& item : node.items) {
    if (item.kind == DataNode::Kind::kSequence) {
      for (const DataNode& inner : item.items) numbers.push_back(Number(inner, key));
    } else {
      numbers.push_back(Number(item, key));
    }
  }
  return numbers;
}

DataFile ReadOpenCvXml(const fs::path& path) {
  DataFile file{path, {}};
  file.root.kind = DataNode::Kind::kMapping;
  std::vector<DataNode*> open = {&file.root};
  std::size_t words = 0;
  const std::vector<XmlTag> tags = ReadXmlTags(path);
  if (tags.empty() || tags.front().name != "opencv_storage")
    throw SetupError(Printable(path.string()) +
                     ": is not XML of OpenCV; expected <opencv_storage>");
  for (std::size_t i = 1; i < tags.size(); ++i) {
    const XmlTag& tag = tags[i];
    if (tag.name.starts_with('/')) {
      if (open.size() > 1) open.pop_back();
      continue;
    }
    DataNode& parent = *open.back();
    const auto fail = [&](const std::string& what) {
      throw SetupError(Printable(path.string()) + ":" + std::to_string(tag.line) + ": <" +
                       Printable(tag.name.substr(0, 40)) + "> " + what);
    };
    // Sequences of unnamed elements are irrelevant for cameras.
    if (parent.kind == DataNode::Kind::kSequence) parent.items.clear();
    parent.kind = DataNode::Kind::kMapping;
    if (tag.name != "_" && parent.Find(tag.name) != nullptr) fail("appears twice");
    if (open.size() > kDeepestElements) fail("is nested too deeply for a calibration");
    if (parent.items.size() >= kMostElements || words >= kMostWords)
      fail("is one element too many for a calibration");
    parent.keys.resize(parent.items.size());
    parent.keys.push_back(tag.name);
    parent.items.emplace_back();
    DataNode& node = parent.items.back();
    node.line = tag.line;
    SetText(tag.text, kMostWords - words, node);
    words += node.items.size();
    if (!tag.is_empty) open.push_back(&node);
  }
  return file;
}

std::string ReadForeignText(const fs::path& file) {
  return ReadWholeFile(file, "a calibration", kLargestFile);
}

std::vector<fs::path> FilesOf(const fs::path& folder_or_file,
                              const std::vector<std::string>& extensions) {
  std::error_code error;
  if (!fs::is_directory(folder_or_file, error)) return {folder_or_file};
  std::vector<fs::path> files;
  fs::directory_iterator entry(folder_or_file, error);
  if (error)
    throw SetupError(Printable(folder_or_file.string()) + ": cannot be listed: " + error.message());
  for (; entry != fs::directory_iterator(); entry.increment(error)) {
    if (error) break;
    std::string extension = entry->path().extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool is_wanted =
        std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
    if (is_wanted && !IsHidden(entry->path())) files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) {
    std::string wanted;
    for (const std::string& extension : extensions)
      wanted += (wanted.empty() ? "" : " or ") + extension;
    throw SetupError(Printable(folder_or_file.string()) + ": contains no file NAME" + wanted +
                     "; expected one for each camera");
  }
  return files;
}

}  // namespace mocap
