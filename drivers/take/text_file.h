// Text files that are written as a whole.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace mocap {

/// Writes a file, over what it held. @throws std::runtime_error  naming it and why it cannot be.
void WriteText(const std::filesystem::path& file, const std::string& text);

/// Writes a file in one step: whoever reads it, or loses power, has the old text or the new one.
/// Keeps its permissions and, as far as may be, its owner; what is no regular file is written to.
/// @throws std::runtime_error  as WriteText; the old text is there still.
void ReplaceText(const std::filesystem::path& file, const std::string& text);

/// Finds out before the work whether ReplaceText can keep its result; leaves the file as it is.
/// @throws SetupError  naming the file and why it cannot be written.
void RequireWritable(const std::filesystem::path& file);

/// Makes sure that writing over a file takes nothing from anybody: it is absent, empty, or begins
/// as the program's own do.
/// @param beginnings  what such a file may begin with.
/// @param kind        for the message, as in "a report".
/// @throws SetupError  naming the file.
void RequireOwn(const std::filesystem::path& file, std::span<const std::string_view> beginnings,
                std::string_view kind);

/// Makes a folder for results unless it is there, before the work.
/// @throws SetupError  naming it.
void MakeFolder(const std::filesystem::path& folder);

}  // namespace mocap
