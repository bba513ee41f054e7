#include "tools/calibration/foreign_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "core/errors.h"
#include "drivers/quoted.h"

namespace mocap {

double FiniteNumber(std::string_view text, const std::string& where) {
  const std::string_view digits = text.substr(text.starts_with('+'));
  double number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool is_number = error == std::errc() && end == digits.data() + digits.size();
  if (!is_number || !std::isfinite(number))
    throw SetupError(where + " is " + Quoted(text) + "; expected a finite number");
  return number;
}

std::vector<ForeignTable> ForeignTable::Tables(std::string_view name) const {
  std::vector<ForeignTable> tables;
  for (const ForeignFile::Place& place : file_->tables) {
    const bool is_inner = place.depth > place_.depth && place.path.starts_with(place_.path);
    if (!is_inner || (name.empty() ? place.depth != place_.depth + 1 : place.name != name))
      continue;
    tables.push_back(*this);
    tables.back().place_ = place;
  }
  return tables;
}

std::optional<ForeignTable> ForeignTable::Table(const std::string& key) const {
  for (const ForeignTable& table : Tables(key)) {
    if (table.place_.depth == place_.depth + 1) return table;
  }
  return std::nullopt;
}

const ForeignValue* ForeignTable::Find(const std::string& key) const {
  const auto place = file_->values.find(place_.path + key);
  if (file_->values.contains(place_.path + key + "#2")) Fail(key, "appears twice");
  return place != file_->values.end() ? &place->second : nullptr;
}

bool ForeignTable::Has(const std::string& key) const {
  return Find(key) != nullptr || Find(key + ".data") != nullptr;
}

std::string ForeignTable::Where(const std::string& key) const {
  int line = 0;
  if (const auto place = file_->values.find(place_.path + key); place != file_->values.end()) {
    line = place->second.line;
  } else {
    // Of the innermost table that lacks it; inner ones follow outer ones.
    for (const ForeignFile::Place& table : file_->tables) {
      if (table.depth > 0 && (place_.path + key + ".").starts_with(table.path)) line = table.line;
    }
  }
  return file_->name + (line > 0 ? ":" + std::to_string(line) : "") + ": " +
         Printable(place_.path + key);
}

void ForeignTable::Fail(const std::string& key, const std::string& what) const {
  throw SetupError(Where(key) + " " + what);
}

const std::vector<std::string>& ForeignTable::Words(const std::string& key) const {
  const ForeignValue* value = Find(key);
  if (value == nullptr) Fail(key, "is missing");
  return value->words;
}

std::string ForeignTable::Text(const std::string& key) const {
  return fmt::format("{}", fmt::join(Words(key), " "));
}

ForeignNumbers ForeignTable::Numbers(const std::string& key) const {
  ForeignNumbers numbers{Where(key), {}};
  if (const ForeignValue* value = Find(key)) {
    if (value->is_string) Fail(key, "has a text; expected numbers");
    for (const std::string& word : value->words)
      numbers.values.push_back(FiniteNumber(word, numbers.where));
    return numbers;
  }
  if (!Has(key)) Fail(key, "is missing; expected numbers");
  numbers.values = Numbers(key + ".data").values;
  const bool has_size = Has(key + ".rows") && Has(key + ".cols");
  if (has_size &&
      Number(key + ".rows") * Number(key + ".cols") != static_cast<double>(numbers.values.size()))
    Fail(key,
         fmt::format("has {} x {} by its rows and cols, but {} numbers; the file may be cut off",
                     Number(key + ".rows"), Number(key + ".cols"), numbers.values.size()));
  return numbers;
}

double ForeignTable::Number(const std::string& key) const {
  const ForeignNumbers numbers = Numbers(key);
  if (numbers.values.size() != 1)
    Fail(key, fmt::format("has {} numbers; expected one", numbers.values.size()));
  return numbers.values[0];
}

}  // namespace mocap
