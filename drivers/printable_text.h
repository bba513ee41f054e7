// Display of untrusted text: names, messages of devices and of the network, files.
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <string_view>

namespace mocap {

/// First character of a text.
struct TextCharacter {
  std::string_view bytes;
  std::optional<char32_t> code;  ///< Empty for a byte that starts no valid UTF-8.
};

/// Removes and returns the first character of a text, which must not be empty.
TextCharacter TakeCharacter(std::string_view& rest);

/// Whether a character may be written to a terminal or log unchanged. Control characters, line and
/// paragraph separators and characters that change the writing direction may not.
bool IsHarmless(char32_t code);

/// Puts a text on one line. Control characters and bytes that are not UTF-8 become `\x1b` or
/// `\u{202e}`. Letters of all languages stay.
std::string Printable(std::string_view text);

/// Like Printable, but keeps line breaks.
std::string PrintableLines(std::string_view text);

/// Like Printable, limited to a number of characters.
std::string Shortened(std::string_view text, std::size_t most_characters);

/// Puts a text in double quotes, as in JSON and TOML. Quotes and backslashes are escaped; bytes
/// that are not UTF-8 become U+FFFD.
/// @param escaped  returns the escape for a character that is not harmless.
std::string InDoubleQuotes(std::string_view text, std::string (*escaped)(char32_t));

/// "1 frame", "2 frames".
std::string Counted(std::integral auto count, std::string_view noun) {
  return std::to_string(count) + ' ' + std::string(noun) + (count == 1 ? "" : "s");
}

}  // namespace mocap
