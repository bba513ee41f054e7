// Foreign text in messages.
#pragma once

#include <string>
#include <string_view>

namespace mocap {

/// Keeps a text on one line and in plain ASCII, whatever stood in the file.
inline std::string Printable(std::string_view text) {
  std::string printable;
  for (const char c : text) printable += c >= 0x20 && c < 0x7f ? c : '?';
  return printable;
}

/// Quotes a text, printable and shortened.
inline std::string Quoted(std::string_view text) {
  constexpr std::size_t kMostCharacters = 40;
  return '"' + Printable(text.substr(0, kMostCharacters)) +
         (text.size() > kMostCharacters ? "...\"" : "\"");
}

}  // namespace mocap
