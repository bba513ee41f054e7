#include "tools/calibration/picture_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <map>
#include <string_view>
#include <vector>

#include "core/errors.h"
#include "drivers/lowered.h"
#include "drivers/quoted.h"
#include "drivers/take/take_layout.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kReadExtensions[] = {".png",  ".jpg", ".jpeg", ".tif",
                                                ".tiff", ".bmp", ".webp"};

struct UnreadKind {
  std::string_view key, name;
};

// Kinds that cameras and telephones save.
constexpr UnreadKind kUnreadKinds[] = {
    {".heic", "HEIC"}, {".heif", "HEIF"}, {".hif", "HEIF"}, {".avif", "AVIF"}, {".jxl", "JPEG XL"},
    {".dng", "Raw"},   {".cr2", "Raw"},   {".cr3", "Raw"},  {".nef", "Raw"},   {".arw", "Raw"},
    {".raf", "Raw"},   {".orf", "Raw"},   {".rw2", "Raw"}};

// Brands of ISO media files that hold a picture.
constexpr UnreadKind kBrands[] = {{"heic", "HEIC"}, {"heix", "HEIC"}, {"hevc", "HEIC"},
                                  {"heim", "HEIC"}, {"mif1", "HEIC"}, {"msf1", "HEIC"},
                                  {"avif", "AVIF"}, {"avis", "AVIF"}};

template <std::size_t N>
std::string_view NameOf(const UnreadKind (&kinds)[N], std::string_view key) {
  const auto* kind = std::ranges::find(kinds, key, &UnreadKind::key);
  return kind == std::end(kinds) ? std::string_view() : kind->name;
}

bool IsFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

std::string_view KindByContent(const fs::path& file) {
  std::array<char, 21> head{};
  std::ifstream(file, std::ios::binary).read(head.data(), head.size());
  const std::string_view bytes(head.data(), head.size());
  if (bytes.substr(4, 4) == "ftyp") return NameOf(kBrands, bytes.substr(8, 4));
  constexpr char kAnimation = 0x02;
  const bool moves = bytes.substr(8, 8) == "WEBPVP8X" && (bytes[20] & kAnimation) != 0;
  return moves ? "Animated WebP" : "";
}

std::string ConvertText(std::string_view kind) {
  return std::string(kind) + " pictures are not read; convert them to JPEG or PNG";
}

}  // namespace

bool IsFolder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

std::vector<fs::path> Listed(const fs::path& folder, bool (*wanted)(const fs::path&)) {
  std::vector<fs::path> paths;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    if (!IsHidden(entry->path()) && wanted(entry->path())) paths.push_back(entry->path());
  }
  if (error) throw SetupError(folder.string() + ": cannot be listed: " + error.message());
  std::ranges::sort(paths);
  return paths;
}

bool IsPicture(const fs::path& file) {
  return std::ranges::count(kReadExtensions, Lowered(file.extension().string())) > 0;
}

void RefuseUnreadPictures(const fs::path& folder) {
  const std::vector<fs::path> files = Listed(folder, IsFile);
  const auto is_unread = [&](const fs::path& file) {
    // Many cameras save each picture twice.
    const auto is_twin = [&](const fs::path& other) {
      return other.stem() == file.stem() && IsPicture(other);
    };
    return !NameOf(kUnreadKinds, Lowered(file.extension().string())).empty() &&
           std::ranges::none_of(files, is_twin);
  };
  const auto first = std::ranges::find_if(files, is_unread);
  if (first == files.end()) return;
  const auto others = std::ranges::count_if(first + 1, files.end(), is_unread);
  throw SetupError(first->string() +
                   (others > 0 ? " and " + std::to_string(others) + " more" : "") + ": " +
                   ConvertText(NameOf(kUnreadKinds, Lowered(first->extension().string()))));
}

void RefuseUnreadPicture(const fs::path& file) {
  const std::string_view kind = KindByContent(file);
  if (!kind.empty())
    throw SetupError(file.string() + ": is " + std::string(kind) + " by its content; " +
                     ConvertText(kind));
  throw SetupError(file.string() + ": is not a readable picture; remove it or save it again");
}

std::string WhatIsThere(const fs::path& folder) {
  std::vector<fs::path> folders = Listed(folder, IsFolder);
  folders.push_back(folder);
  std::map<std::string, int> counts;
  for (const fs::path& place : folders) {
    for (const fs::path& file : Listed(place, IsFile)) ++counts[Lowered(file.extension().string())];
  }
  std::string text;
  for (const auto& [extension, count] : counts) {
    text += text.empty() ? "; it has " : ", ";
    text += std::to_string(count) + (count == 1 ? " file " : " files ");
    text += extension.empty() ? "without an extension" : Printable(extension);
  }
  return text;
}

}  // namespace mocap
