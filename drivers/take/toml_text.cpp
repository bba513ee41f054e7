#include "drivers/take/toml_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "core/errors.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

/// Stands for bytes that are no UTF-8, which TOML cannot hold: U+FFFD.
constexpr std::string_view kReplacement = "\xef\xbf\xbd";

}  // namespace

std::string TomlText(std::string_view text) {
  std::string quoted = "\"";
  while (!text.empty()) {
    const TextCharacter character = TakeCharacter(text);
    if (character.bytes == "\"" || character.bytes == "\\") {
      quoted += '\\' + std::string(character.bytes);
    } else if (!character.code) {
      quoted += kReplacement;
    } else if (IsHarmless(*character.code)) {
      quoted += character.bytes;
    } else {
      std::array<char, 16> escape{};
      std::snprintf(escape.data(), escape.size(), "\\U%08x",
                    static_cast<unsigned>(*character.code));
      quoted += escape.data();
    }
  }
  return quoted + '"';
}

std::string TomlNumber(double value) {
  MOCAP_CHECK(std::isfinite(value));
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  std::string number(digits.data(), end);
  if (number.find_first_of(".e") == std::string::npos) number += ".0";
  return number;
}

}  // namespace mocap
