// Text is made printable where it leaves the program: where errors are printed, in the log's
// format, in the status text, and before mocap prints what a daemon or the network sent. If each
// input had a rule of its own, the next one would lack it. Inside the program, and in files and
// JSON, names stay as they are.
#include "drivers/printable_text.h"

#include <glib.h>

#include <array>
#include <cstdio>

namespace mocap {
namespace {

// They join or separate letters in Persian, Hindi and others, and parts of emoji.
constexpr char32_t kNonJoiner = 0x200c, kJoiner = 0x200d;

std::string Escape(const TextCharacter& character) {
  std::array<char, 16> text{};
  const bool is_wide = character.code && *character.code > 0x7f;
  const auto number = is_wide ? static_cast<unsigned>(*character.code)
                              : static_cast<unsigned char>(character.bytes[0]);
  std::snprintf(text.data(), text.size(), is_wide ? "\\u{%x}" : "\\x%02x", number);
  return text.data();
}

std::string Shown(const TextCharacter& character) {
  const bool is_harmless = character.code && IsHarmless(*character.code);
  return is_harmless ? std::string(character.bytes) : Escape(character);
}

}  // namespace

TextCharacter TakeCharacter(std::string_view& rest) {
  TextCharacter character{rest.substr(0, 1), {}};
  // GLib treats a zero byte as the end of the text.
  const gunichar code =
      rest[0] == '\0' ? 0 : g_utf8_get_char_validated(rest.data(), std::ssize(rest));
  if (code < static_cast<gunichar>(-2)) {
    character.code = code;
    character.bytes = rest.substr(0, static_cast<std::size_t>(g_unichar_to_utf8(code, nullptr)));
  }
  rest.remove_prefix(character.bytes.size());
  return character;
}

bool IsHarmless(char32_t code) {
  if (code == kNonJoiner || code == kJoiner) return true;
  const GUnicodeType type = g_unichar_type(code);
  const bool ends_a_line =
      type == G_UNICODE_LINE_SEPARATOR || type == G_UNICODE_PARAGRAPH_SEPARATOR;
  return g_unichar_isprint(code) && !ends_a_line;
}

std::string Printable(std::string_view text) {
  std::string printable;
  while (!text.empty()) printable += Shown(TakeCharacter(text));
  return printable;
}

std::string PrintableLines(std::string_view text) {
  std::string printable;
  while (!text.empty()) {
    const TextCharacter character = TakeCharacter(text);
    printable += character.bytes == "\n" ? "\n" : Shown(character);
  }
  return printable;
}

std::string InDoubleQuotes(std::string_view text, std::string (*escaped)(char32_t)) {
  constexpr char32_t kReplacement = 0xfffd;
  std::string quoted = "\"";
  while (!text.empty()) {
    const TextCharacter character = TakeCharacter(text);
    if (character.bytes == "\"" || character.bytes == "\\") {
      quoted += '\\' + std::string(character.bytes);
    } else {
      const char32_t code = character.code.value_or(kReplacement);
      quoted += character.code && IsHarmless(code) ? std::string(character.bytes) : escaped(code);
    }
  }
  return quoted + '"';
}

std::string Shortened(std::string_view text, std::size_t most_characters) {
  std::string shortened;
  for (std::size_t i = 0; i < most_characters && !text.empty(); ++i) {
    shortened += Shown(TakeCharacter(text));
  }
  return text.empty() ? shortened : shortened + "...";
}

}  // namespace mocap
