// A report: a page of the view, saved with all it needs as one HTML file.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/base/json.h"

namespace mocap {

/// Beginnings of our pages; other files are not overwritten.
inline constexpr std::string_view kReportBeginnings[] = {
    "<!doctype html><!-- written by mocap -->",
    "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
    "content=\"width=device-width,initial-scale=1\"><title>"};

/// Checks in advance that a report can be written to a file.
/// @throws SetupError  when it is no .html, cannot be written, or is somebody else's.
void RequireRoomForReport(const std::filesystem::path& file);

/// Writes a page of sections. The script report.js draws each by its `type`.
/// @param under  below the title.
std::string ReportHtml(const std::string& title, const std::string& under, const Json& sections);

/// The module of the page and all that it imports, as one script.
std::string ScriptOf(std::string_view module);

/// Appends sections to others.
void Append(const Json& added, Json& sections);

Json Heading(const std::string& text);
/// @param tone  ok, warn or bad; empty: plain.
Json Paragraph(const std::string& text, const std::string& tone = "");
/// @param value  null if it is unknown. @param unit  may be empty.
Json Tile(const std::string& name, const Json& value, int decimals, const std::string& unit,
          const std::string& under);
Json Tiles(Json tiles);

/// Names are text; other cells are numbers, or null if unknown.
struct TableColumn {
  std::string name;
  int decimals = kText;
  bool bars = false;       ///< Beside the numbers.
  bool with_sign = false;  ///< With + before positive numbers.

  static constexpr int kText = -1;
};
Json Table(std::initializer_list<TableColumn> columns, Json rows);
/// A table of names and numbers, with bars.
Json BarTable(const std::string& names, const std::string& unit, int decimals, const Json& values);
/// Lists of sections side by side.
Json Beside(Json sections);

/// One or more plots with a caption. svg_plot.js describes plots.
Json Figure(const std::string& title, const std::string& caption, Json plots, int columns = 1);
/// A curve or point cloud of a plot.
/// @param figure  colour. @param more  further fields, such as x.
Json Series(const std::string& label, int figure, const std::string& mark, Json y,
            Json more = Json::object());

/// A number with three decimals; null if it is not finite.
Json NumberOrNull(double value);

}  // namespace mocap
