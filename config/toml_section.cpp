#include "config/toml_section.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "config/parse_toml.h"
#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"

namespace mocap {
namespace {

constexpr std::size_t kLongestKey = 80;

std::string Shown(double value) {
  std::ostringstream out;
  // Adding zero turns -0 into 0.
  out << value + 0.0;
  return out.str();
}

// Formats a value for a message: short, and on one line.
std::string Shown(const toml::node& node) {
  if (const auto* text = node.as_string()) return Quoted(text->get());
  if (const auto* number = node.as_floating_point()) return Shown(number->get());
  if (const auto* number = node.as_integer()) return std::to_string(number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto* array = node.as_array()) {
    return "an array of " + std::to_string(array->size());
  }
  return node.is_table() ? "a table" : "a date";
}

}  // namespace

std::filesystem::path Resolved(const std::filesystem::path& file, const std::string& path) {
  if (path.empty()) return {};
  return PlainFolder(file.parent_path() / path);
}

TomlSection TomlSection::ReadFile(const std::filesystem::path& file) {
  return ReadText(ReadTomlText(file), file.string());
}

TomlSection TomlSection::ReadText(std::string_view text, const std::string& name) {
  auto root = std::make_shared<const toml::table>(ParseToml(text, name));
  const toml::table* table = root.get();
  return {std::move(root), table, name, ""};
}

TomlSection::TomlSection(std::shared_ptr<const toml::table> root, const toml::table* table,
                         std::string file, std::string path)
    : root_(std::move(root)), table_(table), file_(std::move(file)), path_(std::move(path)) {}

std::vector<std::string> TomlSection::Keys() const {
  std::vector<std::pair<toml::source_position, std::string>> found;
  for (const auto& [key, node] : *table_) {
    found.emplace_back(key.source().begin, std::string(key.str()));
  }
  std::sort(found.begin(), found.end());
  std::vector<std::string> keys;
  for (auto& [position, key] : found) keys.push_back(std::move(key));
  return keys;
}

double TomlSection::Number(const std::string& key, std::optional<double> fallback) {
  if (fallback && !Has(key)) return *fallback;
  return NumberFrom(Need(key, "a number"), key, "a number");
}

double TomlSection::PositiveNumber(const std::string& key, std::optional<double> fallback) {
  const double value = Number(key, fallback);
  if (!(value > 0)) Fail(key, "is " + Shown(value) + "; expected a number above 0");
  return value;
}

double TomlSection::NumberWithin(const std::string& key, double min, double max,
                                 std::optional<double> fallback) {
  const double value = Number(key, fallback);
  if (!(value >= min && value <= max)) {
    Fail(key,
         "is " + Shown(value) + "; expected a number from " + Shown(min) + " to " + Shown(max));
  }
  return value;
}

std::int64_t TomlSection::IntegerWithin(const std::string& key, std::int64_t min, std::int64_t max,
                                        std::optional<std::int64_t> fallback) {
  if (fallback && !Has(key)) return *fallback;
  const std::string wanted =
      "a whole number from " + std::to_string(min) + " to " + std::to_string(max);
  const toml::node& node = Need(key, wanted);
  const auto* value = node.as_integer();
  if (!value || value->get() < min || value->get() > max) {
    Fail(key, "is " + Shown(node) + "; expected " + wanted);
  }
  return value->get();
}

bool TomlSection::Flag(const std::string& key, std::optional<bool> fallback) {
  if (fallback && !Has(key)) return *fallback;
  const toml::node& node = Need(key, "true or false");
  if (!node.is_boolean()) Fail(key, "is " + Shown(node) + "; expected true or false");
  return node.as_boolean()->get();
}

std::string TomlSection::Text(const std::string& key, std::optional<std::string> fallback) {
  if (fallback && !Has(key)) return *fallback;
  const toml::node& node = Need(key, "a string");
  if (!node.is_string()) Fail(key, "is " + Shown(node) + "; expected a string");
  return node.as_string()->get();
}

std::size_t TomlSection::Choice(const std::string& key, const std::vector<std::string>& choices,
                                std::optional<std::size_t> fallback) {
  if (fallback && !Has(key)) return *fallback;
  const std::string found = Text(key);
  const auto place = std::find(choices.begin(), choices.end(), found);
  if (place == choices.end()) {
    std::string wanted;
    for (const std::string& choice : choices) {
      wanted += (wanted.empty() ? "\"" : " or \"") + choice + '"';
    }
    Fail(key, "is " + Quoted(found) + "; " + WithNearestName(found, choices, "expected " + wanted));
  }
  return static_cast<std::size_t>(place - choices.begin());
}

std::vector<std::string> TomlSection::Texts(const std::string& key) {
  const toml::node& node = Need(key, "an array of strings");
  const toml::array* array = node.as_array();
  if (!array) Fail(key, "is " + Shown(node) + "; expected an array of strings");
  std::vector<std::string> texts;
  for (const toml::node& element : *array) {
    if (!element.is_string()) Fail(key, "has " + Shown(element) + "; expected strings");
    texts.push_back(element.as_string()->get());
  }
  return texts;
}

std::vector<double> TomlSection::Numbers(const std::string& key, std::size_t count) {
  const std::string wanted = "an array of " + std::to_string(count) + " numbers";
  std::vector<double> numbers;
  for (const toml::node& element : NeedArray(key, count, wanted)) {
    numbers.push_back(NumberFrom(element, key, wanted));
  }
  return numbers;
}

std::vector<double> TomlSection::Numbers(const std::string& key, std::size_t few,
                                         std::size_t many) {
  const std::string wanted =
      "an array of " + std::to_string(few) + " or " + std::to_string(many) + " numbers";
  const toml::array* array = Need(key, wanted).as_array();
  if (array && array->size() == many) return Numbers(key, many);
  if (array && array->size() == few) return Numbers(key, few);
  Fail(key, "is " + Shown(Need(key, wanted)) + "; expected " + wanted);
}

std::vector<double> TomlSection::AllNumbers(const std::string& key) {
  if (!Has(key)) return {};
  const std::string wanted = "an array of numbers";
  std::vector<double> numbers;
  const toml::node& node = Need(key, wanted);
  if (!node.is_array()) Fail(key, "is " + Shown(node) + "; expected " + wanted);
  for (const toml::node& element : *node.as_array()) {
    if (const toml::array* row = element.as_array()) {
      for (const toml::node& inner : *row) numbers.push_back(NumberFrom(inner, key, wanted));
    } else {
      numbers.push_back(NumberFrom(element, key, wanted));
    }
  }
  return numbers;
}

bool TomlSection::IsTable(const std::string& key) {
  const toml::node* node = Find(key);
  return node != nullptr && node->is_table();
}

bool TomlSection::IsArray(const std::string& key) {
  const toml::node* node = Find(key);
  return node != nullptr && node->is_array();
}

std::vector<int> TomlSection::Integers(const std::string& key, int min, int max) {
  if (!Has(key)) return {};
  const std::string wanted =
      "an array of whole numbers from " + std::to_string(min) + " to " + std::to_string(max);
  const toml::node& node = Need(key, "an array of whole numbers");
  const toml::array* array = node.as_array();
  if (!array) Fail(key, "is " + Shown(node) + "; expected " + wanted);
  std::vector<int> integers;
  for (const toml::node& element : *array) {
    const auto integer = element.value_exact<std::int64_t>();
    if (!integer || *integer < min || *integer > max)
      Fail(key, "has " + Shown(element) + "; expected " + wanted);
    integers.push_back(static_cast<int>(*integer));
  }
  return integers;
}

Vector3 TomlSection::Vector(const std::string& key) {
  const std::vector<double> numbers = Numbers(key, 3);
  return {numbers[0], numbers[1], numbers[2]};
}

Matrix3 TomlSection::Matrix(const std::string& key) {
  const std::string wanted = "a matrix of 3 rows of 3 numbers";
  Matrix3 matrix;
  int row = 0;
  for (const toml::node& element : NeedArray(key, 3, wanted)) {
    const toml::array* numbers = element.as_array();
    if (!numbers || numbers->size() != 3) {
      Fail(key, "has a row that is " + Shown(element) + "; expected " + wanted);
    }
    int column = 0;
    for (const toml::node& number : *numbers) {
      matrix(row, column++) = NumberFrom(number, key, wanted);
    }
    ++row;
  }
  return matrix;
}

std::optional<TomlSection> TomlSection::Section(const std::string& key) {
  const toml::node* node = Find(key);
  if (!node) return std::nullopt;
  if (!node->is_table()) Fail(key, "is " + Shown(*node) + "; expected a table");
  return TomlSection(root_, node->as_table(), file_, PathOf(key) + ".");
}

TomlSection TomlSection::NeededSection(const std::string& key, const std::string& wanted) {
  Need(key, wanted);
  return *Section(key);
}

std::vector<TomlSection> TomlSection::Sections(const std::string& key) {
  const toml::node* node = Find(key);
  std::vector<TomlSection> sections;
  if (!node) return sections;
  const toml::array* array = node->as_array();
  if (!array) Fail(key, "is " + Shown(*node) + "; expected [[" + PathOf(key) + "]]");
  for (const toml::node& element : *array) {
    if (!element.is_table()) {
      Fail(key, "has " + Shown(element) + "; expected [[" + PathOf(key) + "]]");
    }
    sections.push_back(TomlSection(root_, element.as_table(), file_,
                                   PathOf(key) + "[" + std::to_string(sections.size()) + "]."));
  }
  return sections;
}

void TomlSection::Reserve(const std::vector<std::string>& keys, const std::string& needs) {
  for (const std::string& key : keys) reserved_.emplace(key, needs);
}

void TomlSection::RejectUnknownKeys() const {
  for (const std::string& key : Keys()) {
    if (asked_for_.contains(key)) continue;
    if (const auto needs = reserved_.find(key); needs != reserved_.end()) Fail(key, needs->second);
    const std::vector<std::string> known(asked_for_.begin(), asked_for_.end());
    Fail(key, "is unknown; " +
                  WithNearestName(key, KeysThatMayBe(), "known here: " + ListedNames(known)));
  }
}

std::vector<std::string> TomlSection::KeysThatMayBe() const {
  std::vector<std::string> keys(asked_for_.begin(), asked_for_.end());
  for (const auto& [key, needs] : reserved_) keys.push_back(key);
  return keys;
}

// A key that nobody has requested yet, where it resembles the one that is missing. One with
// replaced letters may be another key: thigh_l and thigh_r.
std::string TomlSection::MisspeltAs(const std::string& key) const {
  for (const std::string& found : Keys()) {
    const bool may_be_other =
        found.size() == key.size() && !std::ranges::is_permutation(found, key);
    if (may_be_other || asked_for_.contains(found) || NearestName(found, {key}).empty()) continue;
    return "; there is " + Shortened(found, kLongestKey) + ": did you mean " + key + "?";
  }
  return {};
}

std::string TomlSection::Where(const std::string& key) const {
  const toml::node* node = table_->get(key);
  const auto line = (node ? node->source() : table_->source()).begin.line;
  return file_ + (line > 0 ? ":" + std::to_string(line) : "") + ": " +
         Shortened(PathOf(key), kLongestKey);
}

void TomlSection::Fail(const std::string& key, const std::string& what) const {
  throw SetupError(Where(key) + " " + what + (root_->empty() ? " (the file is empty)" : ""));
}

const toml::node* TomlSection::Find(std::string_view key) {
  asked_for_.emplace(key);
  return table_->get(key);
}

const toml::node& TomlSection::Need(const std::string& key, const std::string& wanted) {
  const toml::node* node = Find(key);
  if (!node) Fail(key, "is missing; expected " + wanted + MisspeltAs(key));
  return *node;
}

const toml::array& TomlSection::NeedArray(const std::string& key, std::size_t count,
                                          const std::string& wanted) {
  const toml::node& node = Need(key, wanted);
  const toml::array* array = node.as_array();
  if (!array || array->size() != count) {
    Fail(key, "is " + Shown(node) + "; expected " + wanted);
  }
  return *array;
}

double TomlSection::NumberFrom(const toml::node& node, const std::string& key,
                               const std::string& wanted) const {
  const std::optional<double> value =
      node.is_number() ? node.value<double>() : std::optional<double>();
  if (!value || !std::isfinite(*value)) {
    Fail(key, "has " + Shown(node) + "; expected " + wanted);
  }
  return *value;
}

std::string TomlSection::PathOf(const std::string& key) const { return path_ + key; }

}  // namespace mocap
