// Which file of a take lies where, and what its cameras may be called.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

namespace mocap {

/// A camera's name is part of file names: letters, digits, `_` and `-`.
inline bool IsCameraName(std::string_view name) {
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
}

/// Tells files that other systems leave in folders: those that begin with a dot, as a Mac's
/// "._cam1.yml" beside cam1.yml.
inline bool IsHidden(const std::filesystem::path& file) {
  return file.filename().native().starts_with('.');
}

/// The files of the take in `folder`.
struct TakeLayout {
  std::filesystem::path folder;

  std::filesystem::path Description() const { return folder / "take.toml"; }
  std::filesystem::path Calibration() const { return folder / "calibration.toml"; }
  std::filesystem::path Video(const std::string& camera) const {
    return folder / (camera + ".mkv");
  }
  std::filesystem::path Table(const std::string& camera) const {
    return folder / (camera + ".csv");
  }
  std::filesystem::path BackgroundVideo(const std::string& camera) const {
    return folder / "background" / (camera + ".mkv");
  }
  std::filesystem::path BackgroundTable(const std::string& camera) const {
    return folder / "background" / (camera + ".csv");
  }
  std::filesystem::path Mask(const std::string& camera) const {
    return folder / "silhouette" / (camera + ".mkv");
  }
  /// The person's sizes, where they were known.
  std::filesystem::path Subject() const { return folder / "subject.toml"; }
  /// The same of one of several people, by number.
  std::filesystem::path Subject(int person) const {
    return folder / ("person-" + std::to_string(person)) / "subject.toml";
  }
  /// What was published while the take was recorded: an LCM log.
  std::filesystem::path Poses() const { return folder / "poses.lcm"; }
  /// The daemon's configuration.
  std::filesystem::path Config() const { return folder / "mocapd.toml"; }
  /// What is known of one of several people, counted from 1: a folder with truth as a take has it.
  TakeLayout Person(int number) const { return {folder / ("person-" + std::to_string(number))}; }
  std::filesystem::path TruthTable() const { return folder / "truth.csv"; }
  std::filesystem::path TruthSizes() const { return folder / "truth.toml"; }
};

}  // namespace mocap
