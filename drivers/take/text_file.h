// Writing of whole text files.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace mocap {

/// Writes a file, replacing its contents. @throws std::runtime_error  naming the file and the
/// reason.
void WriteText(const std::filesystem::path& file, const std::string& text);

/// Writes a file atomically: readers see the old text or the new one, even after a power loss.
/// Keeps its permissions and, if permitted, its owner. A file that is not regular is written
/// directly.
/// @throws std::runtime_error  as WriteText; the old text is kept.
void ReplaceText(const std::filesystem::path& file, const std::string& text);

/// Checks in advance whether ReplaceText can write its result; does not change the file.
/// @throws SetupError  naming the file and the reason.
void RequireWritable(const std::filesystem::path& file);

/// Checks that a file to write has the suffix by which other programs recognize it, in any case.
/// @param suffix  such as ".html". @throws SetupError  naming both.
void RequireSuffix(const std::filesystem::path& file, std::string_view suffix);

/// Whether a file exists and begins like the program's own files.
/// @throws SetupError  when it cannot be read.
bool IsOwnFile(const std::filesystem::path& file, std::span<const std::string_view> beginnings);

/// Checks that overwriting a file loses nobody's data: it is absent, empty, or begins like the
/// program's own files.
/// @param beginnings  of the program's own files.
/// @param kind        for the message, such as "a report".
/// @throws SetupError  naming the file.
void RequireOwn(const std::filesystem::path& file, std::span<const std::string_view> beginnings,
                std::string_view kind);

/// Creates a folder for results unless it exists; call it before the work.
/// @throws SetupError  naming it.
void MakeFolder(const std::filesystem::path& folder);

}  // namespace mocap
