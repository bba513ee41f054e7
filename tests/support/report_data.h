// The data of a report, as the page reads them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace mocap::testing {

/// @return the JSON in a report's page; null if there is none.
inline nlohmann::ordered_json ReportData(const std::string& html) {
  constexpr std::string_view kBegin = "id=\"data\">";
  const std::size_t begin = html.find(kBegin) + kBegin.size();
  const std::string text = html.substr(begin, html.find('<', begin) - begin);
  return nlohmann::ordered_json::parse(text, nullptr, false);
}

/// @return the sections of a type, with those inside others.
inline std::vector<nlohmann::ordered_json> SectionsOf(const nlohmann::ordered_json& within,
                                                      std::string_view type) {
  std::vector<nlohmann::ordered_json> found;
  if (within.is_object() && within.value("type", "") == type) found.push_back(within);
  if (!within.is_structured()) return found;
  for (const auto& inner : within) {
    for (auto& section : SectionsOf(inner, type)) found.push_back(std::move(section));
  }
  return found;
}

/// @return the only table whose first column has a name; null if there is none.
inline nlohmann::ordered_json TableOf(const nlohmann::ordered_json& within,
                                      std::string_view first_column) {
  for (auto& table : SectionsOf(within, "table")) {
    if (table["columns"][0]["name"] == first_column) return table;
  }
  return nullptr;
}

/// @return the first figure with a title; null if there is none.
inline nlohmann::ordered_json FigureOf(const nlohmann::ordered_json& within,
                                       std::string_view title) {
  for (auto& figure : SectionsOf(within, "figure")) {
    if (figure["title"] == title) return figure;
  }
  return nullptr;
}

}  // namespace mocap::testing
