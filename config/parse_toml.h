// The only TOML parser entry point; accepts text from any origin.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace mocap {

/// Parses TOML, also with a byte order mark and with any line endings.
///
/// The parser handles nested tables by recursion, so that a key with very many parts would crash
/// the program. Deeper nesting than in any file of ours is rejected beforehand.
/// @param name  used for the text in messages.
/// @throws SetupError  with the line.
toml::table ParseToml(std::string_view text, const std::string& name);

/// Reads and parses a file. @throws SetupError  also if it cannot be read or is too large.
toml::table ParseTomlFile(const std::filesystem::path& file);

/// Reads the text of a TOML file. @throws SetupError  if it cannot be read or is too large.
std::string ReadTomlText(const std::filesystem::path& file);

}  // namespace mocap
