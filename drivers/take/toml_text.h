// TOML as text, for files that a recording leaves.
#pragma once

#include <string>
#include <string_view>

namespace mocap {

/// Quotes a text. Bytes that are no UTF-8 are replaced, for TOML cannot hold them.
std::string TomlText(std::string_view text);
/// Writes a number so that reading gives back the same bits; always as a float.
std::string TomlNumber(double value);

}  // namespace mocap
