#include "daemon/control/json_object.h"

#include <fmt/format.h>

#include <cmath>

#include "core/errors.h"

namespace mocap {
namespace {

std::string Quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

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

void JsonObject::Add(std::string_view name, std::string_view text) { AddRaw(name, Quoted(text)); }

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
  for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + Quoted(text);
  AddRaw(name, '[' + list + ']');
}

void JsonObject::AddRaw(std::string_view name, std::string_view value) {
  members_ += fmt::format("{}{}: {}", members_.empty() ? "" : ", ", Quoted(name), value);
}

}  // namespace mocap
