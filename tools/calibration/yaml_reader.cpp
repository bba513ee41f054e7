// Reads YAML from libyaml's events. Neither its parser nor this code recurses.
#include <yaml.h>

#include <algorithm>
#include <map>
#include <memory>

#include "core/errors.h"
#include "drivers/quoted.h"
#include "tools/calibration/data_tree.h"

namespace mocap {
namespace {

constexpr std::size_t kDeepest = 16;
constexpr std::size_t kMostNodes = 2'000'000, kMostKeys = 10'000;

std::string_view TextOf(const yaml_char_t* text, std::size_t size) {
  return {reinterpret_cast<const char*>(text), size};
}

std::string Name(const yaml_char_t* anchor) {
  return anchor == nullptr ? "" : reinterpret_cast<const char*>(anchor);
}

std::size_t CountNodes(const DataNode& node) {
  std::size_t count = 1;
  for (const DataNode& item : node.items) count += CountNodes(item);
  return count;
}

std::size_t DepthOf(const DataNode& node) {
  std::size_t depth = 0;
  for (const DataNode& item : node.items) depth = std::max(depth, DepthOf(item));
  return depth + 1;
}

/// Builds a tree from events.
class TreeMaker {
 public:
  explicit TreeMaker(std::string file) : file_(std::move(file)) {}

  /// @return  whether the document continues.
  bool Take(const yaml_event_t& event) {
    line_ = static_cast<int>(event.start_mark.line) + 1;
    switch (event.type) {
      case YAML_SCALAR_EVENT: {
        DataNode node;
        node.text = TextOf(event.data.scalar.value, event.data.scalar.length);
        Add(std::move(node), Name(event.data.scalar.anchor));
        break;
      }
      case YAML_SEQUENCE_START_EVENT:
        Open(DataNode::Kind::kSequence, Name(event.data.sequence_start.anchor));
        break;
      case YAML_MAPPING_START_EVENT:
        Open(DataNode::Kind::kMapping, Name(event.data.mapping_start.anchor));
        break;
      case YAML_SEQUENCE_END_EVENT:
      case YAML_MAPPING_END_EVENT:
        Close();
        break;
      case YAML_ALIAS_EVENT:
        AddAlias(Name(event.data.alias.anchor));
        break;
      case YAML_DOCUMENT_END_EVENT:
      case YAML_STREAM_END_EVENT:
        return false;
      default:
        break;
    }
    return true;
  }

  DataNode Root() && { return std::move(root_); }
  bool has_root() const { return has_root_; }

 private:
  struct OpenNode {
    DataNode node;
    std::string anchor;
    bool awaits_key = true;
  };

  [[noreturn]] void Fail(const std::string& what) const {
    throw SetupError(file_ + ":" + std::to_string(line_) + ": " + what);
  }

  void Open(DataNode::Kind kind, std::string anchor) {
    if (open_.size() >= kDeepest) Fail("is nested too deeply for a calibration");
    OpenNode open;
    open.node.kind = kind;
    open.node.line = line_;
    open.anchor = std::move(anchor);
    open_.push_back(std::move(open));
  }

  void Close() {
    OpenNode closed = std::move(open_.back());
    open_.pop_back();
    Add(std::move(closed.node), closed.anchor);
  }

  void AddAlias(const std::string& anchor) {
    const auto place = anchors_.find(anchor);
    if (place == anchors_.end()) Fail("*" + Printable(anchor) + " is not defined");
    nodes_ += CountNodes(place->second);
    if (nodes_ > kMostNodes || open_.size() + DepthOf(place->second) > kDeepest)
      Fail("is too large for a calibration");
    Add(place->second, "");
  }

  void Add(DataNode node, const std::string& anchor) {
    if (++nodes_ > kMostNodes) Fail("is too large for a calibration");
    if (node.line == 0) node.line = line_;
    if (!anchor.empty()) {
      nodes_ += CountNodes(node);
      anchors_[anchor] = node;
    }
    if (open_.empty()) {
      root_ = std::move(node);
      has_root_ = true;
      return;
    }
    OpenNode& parent = open_.back();
    if (parent.node.kind == DataNode::Kind::kSequence) {
      parent.node.items.push_back(std::move(node));
      return;
    }
    if (parent.awaits_key) {
      if (node.kind != DataNode::Kind::kText) Fail("has a key that is not text");
      if (parent.node.keys.size() >= kMostKeys) Fail("is too large for a calibration");
      if (parent.node.Find(node.text) != nullptr) Fail(Quoted(node.text) + " appears twice");
      parent.node.keys.push_back(std::move(node.text));
    } else {
      parent.node.items.push_back(std::move(node));
    }
    parent.awaits_key = !parent.awaits_key;
  }

  std::string file_;
  int line_ = 0;
  std::vector<OpenNode> open_;
  std::map<std::string, DataNode> anchors_;
  std::size_t nodes_ = 0;
  DataNode root_;
  bool has_root_ = false;
};

// OpenCV's first line, "%YAML:1.0", is not valid YAML.
void DropDirective(std::string& text) {
  const std::size_t begin = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  if (text.compare(begin, 5, "%YAML") != 0) return;
  for (std::size_t i = begin; i < text.size() && text[i] != '\n' && text[i] != '\r'; ++i)
    text[i] = i == begin ? '#' : ' ';
}

}  // namespace

DataFile ReadYaml(const std::filesystem::path& path) {
  std::string text = ReadForeignText(path);
  DropDirective(text);
  const std::string name = Printable(path.string());
  yaml_parser_t parser;
  MOCAP_CHECK(yaml_parser_initialize(&parser) != 0);
  const std::unique_ptr<yaml_parser_t, void (*)(yaml_parser_t*)> parser_end(&parser,
                                                                            yaml_parser_delete);
  yaml_parser_set_input_string(&parser, reinterpret_cast<const unsigned char*>(text.data()),
                               text.size());
  TreeMaker tree(name);
  for (bool goes_on = true; goes_on;) {
    yaml_event_t event;
    if (yaml_parser_parse(&parser, &event) == 0)
      throw SetupError(
          name + ":" + std::to_string(parser.problem_mark.line + 1) +
          ": is not YAML: " + Printable(parser.problem != nullptr ? parser.problem : "no memory"));
    const std::unique_ptr<yaml_event_t, void (*)(yaml_event_t*)> event_end(&event,
                                                                           yaml_event_delete);
    goes_on = tree.Take(event);
  }
  if (!tree.has_root()) throw SetupError(name + ": is empty; expected a calibration");
  DataFile file{path, std::move(tree).Root()};
  if (file.root.kind != DataNode::Kind::kMapping)
    throw SetupError(name + ": contains no keys with values; expected a calibration");
  return file;
}

}  // namespace mocap
