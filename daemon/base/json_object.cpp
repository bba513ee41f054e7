#include "daemon/base/json_object.h"

#include <fmt/format.h>

#include <cmath>

#include "core/errors.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

std::string Escaped(char32_t code) {
  if (code < 0x10000) return fmt::format("\\u{:04x}", static_cast<unsigned>(code));
  const auto rest = static_cast<unsigned>(code - 0x10000);
  return fmt::format("\\u{:04x}\\u{:04x}", 0xd800 + (rest >> 10), 0xdc00 + (rest & 0x3ff));
}

/// Also escapes characters that a terminal would interpret.
std::string InQuotes(std::string_view text) { return InDoubleQuotes(text, Escaped); }

}  // namespace

void JsonObject::Add(std::string_view name, double value, int decimals) {
  MOCAP_CHECK(std::isfinite(value));
  const double scale = std::pow(10, decimals);
  // Adding zero turns -0 into 0.
  AddRaw(name, fmt::format("{}", std::round(value * scale) / scale + 0.0));
}

void JsonObject::Add(std::string_view name, std::int64_t value) {
  AddRaw(name, std::to_string(value));
}

void JsonObject::Add(std::string_view name, bool value) { AddRaw(name, value ? "true" : "false"); }

void JsonObject::Add(std::string_view name, std::string_view text) { AddRaw(name, InQuotes(text)); }

void JsonObject::Add(std::string_view name, const JsonObject& object) {
  AddRaw(name, object.Text());
}

void JsonObject::Add(std::string_view name, std::span<const JsonObject> objects) {
  std::string list;
  for (const JsonObject& object : objects) list += (list.empty() ? "" : ", ") + object.Text();
  AddRaw(name, '[' + list + ']');
}

void JsonObject::Add(std::string_view name, std::span<const std::string> texts) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + InQuotes(text);
  AddRaw(name, '[' + list + ']');
}

void JsonObject::AddRaw(std::string_view name, std::string_view value) {
  members_ += fmt::format("{}{}: {}", members_.empty() ? "" : ", ", InQuotes(name), value);
}

}  // namespace mocap
