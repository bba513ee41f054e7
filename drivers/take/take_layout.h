// File names in a take, and valid camera names.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

namespace mocap {

/// Checks a camera's name, which is part of file names: letters, digits, `_` and `-`.
inline bool IsCameraName(std::string_view name) {
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
}

/// Recognizes files that other systems leave in folders. They begin with a dot, such as a Mac's
/// "._cam1.yml" beside cam1.yml.
inline bool IsHidden(const std::filesystem::path& file) {
  return file.filename().native().starts_with('.');
}

/// The mask beside a background's video: white where the camera never saw the empty studio. Without
/// the file, it saw all of it.
inline std::filesystem::path UnseenBeside(std::filesystem::path background_video) {
  return background_video.replace_extension(".unseen.mkv");
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
  std::filesystem::path Background() const { return folder / "background"; }
  std::filesystem::path BackgroundVideo(const std::string& camera) const {
    return Background() / (camera + ".mkv");
  }
  std::filesystem::path BackgroundTable(const std::string& camera) const {
    return Background() / (camera + ".csv");
  }
  std::filesystem::path BackgroundUnseen(const std::string& camera) const {
    return UnseenBeside(BackgroundVideo(camera));
  }
  std::filesystem::path Masks() const { return folder / "silhouette"; }
  std::filesystem::path Mask(const std::string& camera) const {
    return Masks() / (camera + ".mkv");
  }
  /// Sizes of the subject, if they were known.
  std::filesystem::path Subject() const { return folder / "subject.toml"; }
  /// Sizes of one of several subjects, by number.
  std::filesystem::path Subject(int person) const {
    return folder / ("person-" + std::to_string(person)) / "subject.toml";
  }
  /// Messages published during the recording: an LCM log.
  std::filesystem::path Poses() const { return folder / "poses.lcm"; }
  /// The daemon's configuration.
  std::filesystem::path Config() const { return folder / "mocapd.toml"; }
  /// Data of one of several people, counted from 1: a folder with the same files of truth as a
  /// take.
  TakeLayout Person(int number) const { return {folder / ("person-" + std::to_string(number))}; }
  std::filesystem::path TruthTable() const { return folder / "truth.csv"; }
  std::filesystem::path TruthSizes() const { return folder / "truth.toml"; }
};

}  // namespace mocap
