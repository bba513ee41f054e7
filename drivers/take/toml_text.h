// Formats TOML for files of a recording.
#pragma once

#include <string>
#include <string_view>

namespace mocap {

/// Quotes a text. Replaces bytes that are not UTF-8, which TOML does not allow.
std::string TomlText(std::string_view text);
/// Formats a number as a float, so that reading restores the same bits.
std::string TomlNumber(double value);

}  // namespace mocap
