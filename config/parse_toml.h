// The one way from text to TOML, whoever wrote the text.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace mocap {

/// Parses TOML, also with a byte order mark and with any ends of lines.
///
/// The parser keeps its tables by recursion, so that a key of very many parts would end the
/// program: what nests deeper than any file of ours is refused before.
/// @param name  what messages call the text.
/// @throws SetupError  naming the line.
toml::table ParseToml(std::string_view text, const std::string& name);

/// Reads and parses a file. @throws SetupError  also when it cannot be read or is too large.
toml::table ParseTomlFile(const std::filesystem::path& file);

/// Reads the text of a TOML file. @throws SetupError  when it cannot be read or is too large.
std::string ReadTomlText(const std::filesystem::path& file);

}  // namespace mocap
