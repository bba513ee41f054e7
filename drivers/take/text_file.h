// Text files that are written as a whole.
#pragma once

#include <filesystem>
#include <string>

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

/// Makes a folder for results unless it is there, before the work.
/// @throws SetupError  naming it.
void MakeFolder(const std::filesystem::path& folder);

}  // namespace mocap
