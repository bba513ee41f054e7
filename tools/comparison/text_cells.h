// Cells of other programs' text tables.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/quoted.h"
#include "drivers/take/text_table.h"
#include "tools/comparison/recorded_motion.h"

namespace mocap {

inline std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

/// Divides a line at every separator, so that empty cells stay.
inline std::vector<std::string_view> CellsOf(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    cells.push_back(Trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return cells;
}

/// Divides a line at blanks.
inline std::vector<std::string_view> WordsOf(std::string_view line) {
  constexpr std::string_view kBlanks = " \t\r";
  std::vector<std::string_view> words;
  for (std::size_t begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

/// Returns NaN for an empty cell, and for what is no number.
inline double NumberOrNan(std::string_view cell) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool is_number =
      error == std::errc() && end == cell.data() + cell.size() && std::isfinite(value);
  return is_number ? value : kUnmeasured;
}

/// @throws SetupError  for what is no number.
inline double NeededNumber(std::string_view cell, std::string_view what, const TextLines& lines) {
  const double value = NumberOrNan(cell);
  if (std::isnan(value))
    lines.Fail(std::string(what) + " is " + Quoted(cell) + "; expected a number");
  return value;
}

/// Adds the time of a row. @throws SetupError  unless times increase.
inline void AddTime(double time_s, std::vector<double>& times, const TextLines& lines) {
  if (!times.empty() && !(time_s > times.back())) {
    lines.Fail("time " + std::to_string(time_s) + " follows " + std::to_string(times.back()) +
               "; expected times that increase");
  }
  times.push_back(time_s);
}

}  // namespace mocap
