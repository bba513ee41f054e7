#include "drivers/take/toml_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "core/errors.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

std::string Escaped(char32_t code) {
  std::array<char, 16> escape{};
  std::snprintf(escape.data(), escape.size(), "\\U%08x", static_cast<unsigned>(code));
  return escape.data();
}

}  // namespace

std::string TomlText(std::string_view text) { return InDoubleQuotes(text, Escaped); }

std::string TomlNumber(double value) {
  MOCAP_CHECK(std::isfinite(value));
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  std::string number(digits.data(), end);
  if (number.find_first_of(".e") == std::string::npos) number += ".0";
  return number;
}

}  // namespace mocap
