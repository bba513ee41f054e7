// Untrusted text in messages.
#pragma once

#include <string>
#include <string_view>

#include "drivers/printable_text.h"

namespace mocap {

/// Quotes a text, printable and shortened.
inline std::string Quoted(std::string_view text) {
  constexpr std::size_t kMostCharacters = 40;
  return '"' + Shortened(text, kMostCharacters) + '"';
}

}  // namespace mocap
