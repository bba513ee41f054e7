#include "tools/report/report_page.h"

#include <fmt/format.h>
#include <glib.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <regex>
#include <set>

#include "core/errors.h"
#include "drivers/printable_text.h"
#include "drivers/take/text_file.h"
#include "tools/page/page_files.h"

namespace mocap {
namespace {

std::string PageText(std::string_view name) {
  const auto files = BuiltinPageFiles();
  const auto file = std::ranges::find(files, name, &BuiltinPageFile::name);
  MOCAP_CHECK(file != files.end());
  return std::string(file->text);
}

// Browsers import no files from a disk, so each module becomes a function, and is called once.
std::string ModulesOf(const std::string& module, std::set<std::string>& written) {
  static const std::regex kImport(R"(import (\{[^}]*\}) from '\./(\w+)\.js';)");
  static const std::regex kExport(R"(export ((?:async )?(?:function|class|const) (\w+)))");
  if (!written.insert(module).second) return {};
  const std::string text = PageText(module + ".js");
  std::string before, names;
  for (std::sregex_iterator it(text.begin(), text.end(), kImport), end; it != end; ++it)
    before += ModulesOf((*it)[2], written);
  for (std::sregex_iterator it(text.begin(), text.end(), kExport), end; it != end; ++it)
    names += (*it)[2].str() + ", ";
  const std::string inner =
      std::regex_replace(std::regex_replace(text, kImport, "const $1 = $2;"), kExport, "$1");
  return fmt::format("{}const {} = (() => {{\n{}return {{{}}};\n}})();\n", before, module, inner,
                     names);
}

/// Allows this text in a page, by its hash.
std::string PolicyOf(const std::string& text) {
  const std::unique_ptr<GChecksum, decltype(&g_checksum_free)> sum(
      g_checksum_new(G_CHECKSUM_SHA256), &g_checksum_free);
  g_checksum_update(sum.get(), reinterpret_cast<const guchar*>(text.data()),
                    static_cast<gssize>(text.size()));
  guint8 digest[32];
  gsize size = sizeof(digest);
  g_checksum_get_digest(sum.get(), digest, &size);
  const std::unique_ptr<char, decltype(&g_free)> base64(g_base64_encode(digest, size), &g_free);
  return fmt::format("'sha256-{}'", base64.get());
}

}  // namespace

void RequireRoomForReport(const std::filesystem::path& file) {
  RequireSuffix(file, ".html");
  RequireWritable(file);
  RequireOwn(file, kReportBeginnings, "a report");
}

std::string ScriptOf(std::string_view module) {
  std::set<std::string> written;
  return ModulesOf(std::string(module), written);
}

std::string ReportHtml(const std::string& title, const std::string& under, const Json& sections) {
  const std::string style = PageText("base.css") + PageText("report.css");
  const std::string script = ScriptOf("report");
  // Without "<", no text ends its element, or begins another one.
  const std::string data = std::regex_replace(
      JsonText({{"title", Printable(title)}, {"under", Printable(under)}, {"sections", sections}}),
      std::regex("<"), "\\u003c");
  return fmt::format(
      R"({}
<html lang="en" data-theme="light"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width,initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src {}; style-src {};
img-src data:; base-uri 'none'; form-action 'none'">
<title>Motion capture report</title><link rel="icon" href="data:,">
<style>{}</style></head>
<body><header id="top"><h1 id="title"></h1><button id="theme" type="button"></button></header>
<main id="report"><noscript>A script in this file draws the report. It loads nothing.</noscript></main>
<script type="application/json" id="data">{}</script>
<script type="module">{}</script></body></html>
)",
      kReportBeginnings[0], PolicyOf(script), PolicyOf(style), style, data, script);
}

void Append(const Json& added, Json& sections) {
  sections.insert(sections.end(), added.begin(), added.end());
}

Json Heading(const std::string& text) { return {{"type", "heading"}, {"text", text}}; }

Json Paragraph(const std::string& text, const std::string& tone) {
  Json paragraph{{"type", "text"}, {"text", text}};
  if (!tone.empty()) paragraph["tone"] = tone;
  return paragraph;
}

Json Tile(const std::string& name, const Json& value, int decimals, const std::string& unit,
          const std::string& under) {
  return {{"name", name},
          {"value", value},
          {"decimals", decimals},
          {"unit", value.is_null() ? "" : unit},
          {"under", under}};
}

Json Tiles(Json tiles) { return {{"type", "tiles"}, {"tiles", std::move(tiles)}}; }

Json Table(std::initializer_list<TableColumn> columns, Json rows) {
  Json table{{"type", "table"}, {"columns", Json::array()}, {"rows", std::move(rows)}};
  for (const TableColumn& column : columns) {
    Json& json = table["columns"].emplace_back(Json{{"name", column.name}});
    if (column.decimals != TableColumn::kText) json["decimals"] = column.decimals;
    if (column.bars) json["bars"] = true;
    if (column.with_sign) json["signed"] = true;
  }
  return table;
}

Json BarTable(const std::string& names, const std::string& unit, int decimals, const Json& values) {
  Json rows = Json::array();
  for (const auto& [name, value] : values.items()) rows.push_back({name, value});
  return Table({{names}, {unit, decimals, true}}, std::move(rows));
}

Json Beside(Json sections) { return {{"type", "columns"}, {"sections", std::move(sections)}}; }

Json Figure(const std::string& title, const std::string& caption, Json plots, int columns) {
  return {{"type", "figure"},
          {"title", title},
          {"caption", caption},
          {"plots", std::move(plots)},
          {"columns", columns}};
}

Json Series(const std::string& label, int figure, const std::string& mark, Json y, Json more) {
  more.update({{"label", label}, {"figure", figure}, {"mark", mark}, {"y", std::move(y)}});
  return more;
}

Json NumberOrNull(double value) {
  constexpr int kDecimals = 3;
  return std::isfinite(value) ? Rounded(value, kDecimals) : Json();
}

}  // namespace mocap
