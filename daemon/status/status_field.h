// What mocapd knows of itself is described once, by tables of fields. Each form is a loop over
// them.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "daemon/base/json.h"

namespace mocap {

/// Which text has a column.
enum class Shown { kInStatus, kInWatch, kInBoth };

/// A column of a table in text.
struct Column {
  std::string_view heading = {};  ///< Empty: no column.
  int width = 0;                  ///< Negative: to the left; 0: the last one.
  int digits = 0;                 ///< Of a fraction.
  double scale = 1;               ///< From the value to what is shown.
  std::string_view unit = {};
  Shown shown = Shown::kInBoth;

  bool IsIn(Shown text) const {
    return !heading.empty() && (shown == text || shown == Shown::kInBoth);
  }
};
constexpr Column Percent(std::string_view heading, int width) {
  return {heading, width, 0, 100, " %"};
}
constexpr Column Only(Shown shown, Column column) {
  column.shown = shown;
  return column;
}

/// A metric for Prometheus. Fields of the same name follow each other; only the first needs a help.
struct Metric {
  std::string_view name = {};  ///< Without the program's name; empty: no metric.
  std::string_view help = {};
  std::string_view label = {};  ///< What tells apart fields of the same name.
  double scale = 1;             ///< From the value to the metric's unit.
};

inline constexpr double kAnyNumber = std::numeric_limits<double>::infinity();

/// One thing that is known of something: of the service, a camera, a person.
template <typename Of>
struct StatusField {
  std::string_view key;  ///< In JSON, with its unit; empty: not there.
  Json (*value)(const Of&);
  int decimals;  ///< Of a fraction in JSON.
  Column column;
  Metric metric;
  bool (*is_known)(const Of&);  ///< Whether it means anything yet; null: always.
  double least, most;           ///< It is good within these.

  bool IsKnown(const Of& of) const { return !is_known || is_known(of); }
  bool IsPoor(const Of& of) const {
    const Json is = value(of);
    return IsKnown(of) && is.is_number() && (is.get<double>() < least || is.get<double>() > most);
  }
};

/// A line of a table.
template <typename Of>
constexpr StatusField<Of> Field(std::string_view key, Json (*value)(const Of&), int decimals = 0,
                                Column column = {}, Metric metric = {},
                                bool (*is_known)(const Of&) = nullptr, double least = -kAnyNumber,
                                double most = kAnyNumber) {
  return {key, value, decimals, column, metric, is_known, least, most};
}

template <typename Of>
Json ObjectOf(std::span<const StatusField<Of>> fields, const Of& of) {
  Json json = Json::object();
  for (const StatusField<Of>& field : fields) {
    if (field.key.empty()) continue;
    Json value = field.value(of);
    json[std::string(field.key)] =
        value.is_number_float() ? Rounded(value.get<double>(), field.decimals) : std::move(value);
  }
  return json;
}

template <typename Of>
Json ObjectsOf(std::span<const StatusField<Of>> fields, const std::vector<Of>& list) {
  Json json = Json::array();
  for (const Of& of : list) json.push_back(ObjectOf(fields, of));
  return json;
}

/// A value as its column shows it, printable; "-" if there is none.
std::string CellText(const Column& column, const Json& value);
/// A cell as wide as its column.
std::string Padded(const Column& column, std::string_view text);

/// A heading and one line for each of a list.
template <typename Of>
std::string TableOf(std::span<const StatusField<Of>> fields, const std::vector<Of>& list,
                    Shown text) {
  std::string head, lines;
  for (const StatusField<Of>& field : fields) {
    if (field.column.IsIn(text)) head += Padded(field.column, field.column.heading);
  }
  for (const Of& of : list) {
    for (const StatusField<Of>& field : fields) {
      if (!field.column.IsIn(text)) continue;
      const Json value = field.IsKnown(of) ? field.value(of) : Json();
      lines += Padded(field.column, CellText(field.column, value));
    }
    lines += '\n';
  }
  return head + '\n' + lines;
}

}  // namespace mocap
