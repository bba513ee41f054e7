// Files in a folder of footage: which are pictures that can be read, and what the others are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mocap {

/// Returns whether a path is a folder that can be found.
bool IsFolder(const std::filesystem::path& path);

/// Lists what is wanted of a folder's visible entries, in the order of their names.
/// @throws SetupError  if the folder cannot be listed.
std::vector<std::filesystem::path> Listed(const std::filesystem::path& folder,
                                          bool (*wanted)(const std::filesystem::path&));

/// Returns whether a file's name is that of a picture that can be read.
bool IsPicture(const std::filesystem::path& file);

/// Refuses a folder with pictures of a kind that is not read, such as HEIC, unless each was also
/// saved as one that is. If they were skipped, nobody would know.
/// @throws SetupError  naming one of them, their number and the remedy.
void RefuseUnreadPictures(const std::filesystem::path& folder);

/// Refuses a file that has the name of a picture but cannot be read as one.
/// @throws SetupError  always; names the kind of picture that it is by its content, if known.
[[noreturn]] void RefuseUnreadPicture(const std::filesystem::path& file);

/// Names the kinds of files in a folder and its subfolders: "; it has 3 files .mts, 1 file .txt".
/// Empty if there are no files.
std::string WhatIsThere(const std::filesystem::path& folder);

}  // namespace mocap
