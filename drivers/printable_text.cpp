#include "drivers/printable_text.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace mocap {
namespace {

struct Range {
  char32_t first, last;
};

constexpr std::array<Range, 12> kHarmful = {{
    {0x00, 0x1f},        // Control characters: C0,
    {0x7f, 0x9f},        // delete and C1.
    {0x061c, 0x061c},    // Marks of direction.
    {0x200b, 0x200b},    // Nothing to see.
    {0x200e, 0x200f},    // Marks of direction.
    {0x2028, 0x202e},    // Ends of lines and paragraphs; embedded and overridden directions.
    {0x2060, 0x206f},    // Nothing to see; isolated directions.
    {0xd800, 0xdfff},    // Halves of characters.
    {0xfeff, 0xfeff},    // A byte order mark.
    {0xfff9, 0xfffb},    // Notes between lines.
    {0xfffe, 0xffff},    // No characters.
    {0xe0000, 0xe007f},  // Tags.
}};

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
  constexpr std::array<char32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
  const auto byte = [&rest](std::size_t i) { return static_cast<unsigned char>(rest[i]); };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xc2 ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
  char32_t code = length == 1 ? first : first & (0x7fu >> length);
  bool is_whole = length > 0 && length <= rest.size();
  for (std::size_t i = 1; is_whole && i < length; ++i) {
    is_whole = (byte(i) & 0xc0) == 0x80;
    code = code << 6 | (byte(i) & 0x3f);
  }
  is_whole = is_whole && code >= kLeast[length] && code <= 0x10ffff;
  TextCharacter character{rest.substr(0, is_whole ? length : 1), {}};
  if (is_whole && !(code >= 0xd800 && code <= 0xdfff)) character.code = code;
  if (!character.code) character.bytes = rest.substr(0, 1);
  rest.remove_prefix(character.bytes.size());
  return character;
}

bool IsHarmless(char32_t code) {
  return std::none_of(kHarmful.begin(), kHarmful.end(), [code](const Range& range) {
    return code >= range.first && code <= range.last;
  });
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
