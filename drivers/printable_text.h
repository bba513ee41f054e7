// Foreign text (names, messages of devices and of the network, files) as it may be shown.
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <string_view>

namespace mocap {

/// A character at the front of a text.
struct TextCharacter {
  std::string_view bytes;
  std::optional<char32_t> code;  ///< Empty for a byte that begins no UTF-8.
};

/// Takes the first character off a text, which must not be empty.
TextCharacter TakeCharacter(std::string_view& rest);

/// Whether a character may go to a terminal or into a log as it is: no control character, no end of
/// a line or paragraph, none that turns the direction of writing.
bool IsHarmless(char32_t code);

/// Keeps a text on one line. Control characters and bytes that are no UTF-8 become `\x1b` or
/// `\u{202e}`. Letters of all languages stay.
std::string Printable(std::string_view text);

/// The same for text of several lines, which stay lines.
std::string PrintableLines(std::string_view text);

/// Printable, and no longer than so many characters.
std::string Shortened(std::string_view text, std::size_t most_characters);

/// Puts a text in double quotes, as JSON and TOML have them: quotes and backslashes behind a
/// backslash, U+FFFD for bytes that are no UTF-8.
/// @param escaped  spells out a character that is not harmless.
std::string InDoubleQuotes(std::string_view text, std::string (*escaped)(char32_t));

/// "1 frame", "2 frames".
std::string Counted(std::integral auto count, std::string_view noun) {
  return std::to_string(count) + ' ' + std::string(noun) + (count == 1 ? "" : "s");
}

}  // namespace mocap
