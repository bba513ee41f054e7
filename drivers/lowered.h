// Text without capitals.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace mocap {

/// The text in lower case; letters beyond ASCII stay.
inline std::string Lowered(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return text;
}

}  // namespace mocap
