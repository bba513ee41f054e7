// YAML, XML and TOML of other programs. Whatever a file holds, nothing recurses deeper than
// FileMaker allows: libyaml gives events, pugixml parses and deletes without recursion, ParseToml
// measures the depth before it parses.
#include <fmt/format.h>
#include <yaml.h>

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>

#include "config/parse_toml.h"
#include "core/errors.h"
#include "drivers/quoted.h"
#include "tools/calibration/foreign_file.h"

namespace mocap {
namespace {

constexpr std::size_t kDeepest = 16, kMostSteps = 2'000'000, kMostKeys = 20'000, kLongestKey = 100;

/// A step through a file.
struct Step {
  enum class Kind { kText, kList, kTable, kEnd };

  Kind kind = Kind::kText;
  std::string text{};
  bool is_string = false;
};

/// Sorts a file's values by their keys. Those of tables follow their keys.
/// @throws SetupError  naming file and line, for more than any calibration has.
class FileMaker {
 public:
  /// @param may_repeat  whether names in a table may be the same.
  explicit FileMaker(const std::string& name, bool may_repeat = false)
      : file_{name}, may_repeat_(may_repeat) {}

  void SetLine(std::size_t line) { line_ = static_cast<int>(line); }
  void Take(const Step& step, const std::string& anchor = {}) {
    if (++steps_ > kMostSteps) Fail("is too large for a calibration");
    for (const Level& level : levels_) {
      if (level.anchor.empty()) continue;
      anchors_[level.anchor].push_back(step);
      ++steps_;
    }
    if (!anchor.empty()) anchors_[anchor] = {step};
    if (step.kind == Step::Kind::kEnd) {
      levels_.pop_back();
    } else if (step.kind == Step::Kind::kText) {
      TakeText(step);
    } else {
      Open(step.kind, anchor);
    }
  }
  void TakeAlias(const std::string& anchor) {
    const auto place = anchors_.find(anchor);
    if (place == anchors_.end() || std::ranges::count(levels_, anchor, &Level::anchor) > 0)
      Fail("*" + Printable(anchor) + " is not defined");
    for (const Step& step : std::vector<Step>(place->second)) Take(step);
  }
  ForeignTable Table() && {
    if (steps_ == 0) throw SetupError(file_.name + ": is empty; expected a calibration");
    if (file_.tables.empty() || file_.tables[0].depth > 0)
      throw SetupError(file_.name + ": contains no keys with values; expected a calibration");
    return ForeignTable(std::move(file_));
  }

 private:
  struct Level {
    bool is_table = false;
    std::string path{};  ///< Of its values: "cam0." of a table, "cam0.resolution" of a list.
    std::string anchor{};
    std::string name{};                   ///< The last one read.
    std::optional<std::string> key{};     ///< The same, numbered, while it awaits its value.
    std::map<std::string, int> counts{};  ///< How often a name occurs.
  };

  [[noreturn]] void Fail(const std::string& what) const {
    throw SetupError(file_.name + ":" + std::to_string(line_) + ": " + what);
  }

  // A name that is unique in the level: "camera", "camera#2" ….
  std::string Numbered(Level& level, const std::string& name) {
    if (name.size() > kLongestKey + level.path.size() || ++keys_ > kMostKeys)
      Fail("is too large for a calibration");
    const int count = ++level.counts[name];
    if (count > 1 && level.is_table && !may_repeat_) Fail(Quoted(name) + " appears twice");
    return name + (count > 1 ? "#" + std::to_string(count) : "");
  }

  // The path of what comes next; consumes its key.
  std::string NextPath() {
    if (levels_.empty()) return "";
    Level& level = levels_.back();
    if (!level.is_table) return level.path;
    if (!level.key) Fail("has a key that is not text");
    const std::string path = level.path + *level.key;
    level.key.reset();
    return path;
  }

  ForeignValue& ValueAt(const std::string& path) {
    return file_.values.try_emplace(path, ForeignValue{line_}).first->second;
  }

  void TakeText(const Step& step) {
    if (!levels_.empty() && levels_.back().is_table && !levels_.back().key) {
      levels_.back().name = step.text;
      levels_.back().key = Numbered(levels_.back(), step.text);
      return;
    }
    ForeignValue& value = ValueAt(NextPath());
    value.words.push_back(step.text);
    value.is_string = value.is_string || step.is_string;
  }

  void Open(Step::Kind kind, const std::string& anchor) {
    if (levels_.size() >= kDeepest) Fail("is nested too deeply for a calibration");
    const bool is_table = kind == Step::Kind::kTable;
    const bool is_in_list = !levels_.empty() && !levels_.back().is_table;
    const bool is_in_row =
        is_in_list && levels_.size() > 1 && !levels_[levels_.size() - 2].is_table;
    const std::string name = !is_in_list && !levels_.empty() ? levels_.back().name : "";
    std::string path = NextPath();
    // Not a number.
    if (is_in_list && (is_table || is_in_row)) ValueAt(path).words.push_back(is_table ? "{" : "[");
    if (is_table) {
      if (is_in_list) path = Numbered(levels_.back(), path);
      if (!levels_.empty()) path += '.';
      file_.tables.push_back({path, name, levels_.size(), line_});
    } else {
      ValueAt(path);
    }
    levels_.push_back({is_table, path, anchor});
  }

  ForeignFile file_;
  bool may_repeat_;
  int line_ = 0;
  std::size_t steps_ = 0, keys_ = 0;
  std::vector<Level> levels_;
  std::map<std::string, std::vector<Step>> anchors_;
};

std::string Name(const yaml_char_t* anchor) {
  return anchor == nullptr ? "" : reinterpret_cast<const char*>(anchor);
}

// @return  whether the document continues.
bool TakeEvent(const yaml_event_t& event, FileMaker& file) {
  using Kind = Step::Kind;
  file.SetLine(event.start_mark.line + 1);
  const auto& data = event.data;
  switch (event.type) {
    case YAML_SCALAR_EVENT:
      file.Take(
          {Kind::kText, {reinterpret_cast<const char*>(data.scalar.value), data.scalar.length}},
          Name(data.scalar.anchor));
      break;
    case YAML_SEQUENCE_START_EVENT:
      file.Take({Kind::kList}, Name(data.sequence_start.anchor));
      break;
    case YAML_MAPPING_START_EVENT:
      file.Take({Kind::kTable}, Name(data.mapping_start.anchor));
      break;
    case YAML_SEQUENCE_END_EVENT:
    case YAML_MAPPING_END_EVENT:
      file.Take({Kind::kEnd});
      break;
    case YAML_ALIAS_EVENT:
      file.TakeAlias(Name(data.alias.anchor));
      break;
    default:
      return event.type != YAML_DOCUMENT_END_EVENT && event.type != YAML_STREAM_END_EVENT;
  }
  return true;
}

// OpenCV's first line, "%YAML:1.0", is not valid YAML.
void DropDirective(std::string& text) {
  const std::size_t begin = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  if (text.compare(begin, 5, "%YAML") != 0) return;
  for (std::size_t i = begin; i < text.size() && text[i] != '\n' && text[i] != '\r'; ++i)
    text[i] = i == begin ? '#' : ' ';
}

void TakeWords(const std::string& text, FileMaker& file) {
  std::istringstream in(text);
  file.Take({Step::Kind::kList});
  for (std::string word; in >> word;) file.Take({Step::Kind::kText, word});
  file.Take({Step::Kind::kEnd});
}

/// Takes elements in the order of the text, whose lines it counts. Attributes and elements inside
/// an element are keys of a table.
struct XmlWalk {
  void Take(const pugi::xml_node& element) {
    for (; at < element.offset_debug(); ++at) line += text[static_cast<std::size_t>(at)] == '\n';
    file.SetLine(line);
    // OpenCV's type_id says nothing that the parts do not say.
    const auto is_data = [](const auto& a) { return std::string_view(a.name()) != "type_id"; };
    const auto is_element = [](const auto& n) { return n.type() == pugi::node_element; };
    if (std::ranges::none_of(element.attributes(), is_data) &&
        std::ranges::none_of(element.children(), is_element)) {
      std::string words;
      for (const pugi::xml_node& child : element.children()) words += child.value();
      return TakeWords(words, file);
    }
    file.Take({Step::Kind::kTable});
    for (const pugi::xml_attribute& attribute : element.attributes()) {
      file.Take({Step::Kind::kText, attribute.name()});
      TakeWords(attribute.value(), file);
    }
    for (const pugi::xml_node& child : element.children()) {
      if (!is_element(child)) continue;
      file.Take({Step::Kind::kText, child.name()});
      Take(child);
    }
    file.Take({Step::Kind::kEnd});
  }

  const std::string& text;
  FileMaker& file;
  std::ptrdiff_t at = 0;
  std::size_t line = 1;
};

void TakeToml(const toml::node& node, FileMaker& file) {
  file.SetLine(node.source().begin.line);
  if (const toml::table* table = node.as_table()) {
    std::vector<std::pair<toml::source_position, std::string>> keys;
    for (const auto& [key, value] : *table) keys.emplace_back(key.source().begin, key.str());
    std::ranges::sort(keys);
    file.Take({Step::Kind::kTable});
    for (const auto& [place, key] : keys) {
      file.Take({Step::Kind::kText, key});
      TakeToml(*table->get(key), file);
    }
    file.Take({Step::Kind::kEnd});
  } else if (const toml::array* array = node.as_array()) {
    file.Take({Step::Kind::kList});
    for (const toml::node& item : *array) TakeToml(item, file);
    file.Take({Step::Kind::kEnd});
  } else if (node.is_number()) {
    file.Take({Step::Kind::kText, fmt::format("{}", node.value_or(0.0))});
  } else if (node.is_boolean()) {
    file.Take({Step::Kind::kText, node.value_or(false) ? "true" : "false"});
  } else {
    file.Take({Step::Kind::kText, node.value_or(std::string("a date")), true});
  }
}

}  // namespace

ForeignTable ForeignTable::OfYaml(std::string text, const std::string& name) {
  DropDirective(text);
  yaml_parser_t parser;
  MOCAP_CHECK(yaml_parser_initialize(&parser) != 0);
  const std::unique_ptr<yaml_parser_t, void (*)(yaml_parser_t*)> parser_end(&parser,
                                                                            yaml_parser_delete);
  yaml_parser_set_input_string(&parser, reinterpret_cast<const unsigned char*>(text.data()),
                               text.size());
  FileMaker file(name);
  for (bool goes_on = true; goes_on;) {
    yaml_event_t event;
    if (yaml_parser_parse(&parser, &event) == 0)
      throw SetupError(
          name + ":" + std::to_string(parser.problem_mark.line + 1) +
          ": is not YAML: " + Printable(parser.problem != nullptr ? parser.problem : "no memory"));
    const std::unique_ptr<yaml_event_t, void (*)(yaml_event_t*)> event_end(&event,
                                                                           yaml_event_delete);
    goes_on = TakeEvent(event, file);
  }
  return std::move(file).Table();
}

ForeignTable ForeignTable::OfXml(const std::string& text, const std::string& name) {
  const auto begins_part = [](char c) { return c == '<' || c == '='; };
  if (std::ranges::count_if(text, begins_part) > static_cast<std::ptrdiff_t>(kMostSteps))
    throw SetupError(name + ": is too large for a calibration");
  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!result)
    throw SetupError(fmt::format("{}:{}: is not XML: {}", name,
                                 1 + std::count(text.data(), text.data() + result.offset, '\n'),
                                 result.description()));
  FileMaker file(name, true);
  file.Take({Step::Kind::kTable});
  file.Take({Step::Kind::kText, document.document_element().name()});
  XmlWalk{text, file}.Take(document.document_element());
  file.Take({Step::Kind::kEnd});
  return std::move(file).Table();
}

ForeignTable ForeignTable::OfToml(const std::string& text, const std::string& name) {
  FileMaker file(name);
  TakeToml(ParseToml(text, name), file);
  return std::move(file).Table();
}

}  // namespace mocap
