// The content of YAML, JSON and OpenCV's XML: texts in sequences and mappings, each with its line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mocap {

struct DataNode {
  enum class Kind { kText, kSequence, kMapping };

  Kind kind = Kind::kText;
  std::string text;
  std::vector<DataNode> items;    ///< Of a sequence or, beside their keys, of a mapping.
  std::vector<std::string> keys;  ///< Of a mapping.
  int line = 0;

  /// Finds a key of a mapping; null where there is none.
  const DataNode* Find(std::string_view key) const;
};

/// A file that was read as a tree.
struct DataFile {
  std::filesystem::path path;
  DataNode root;

  /// Gives "file:line", for messages.
  std::string At(const DataNode& node) const;
  /// Reads a number. @throws SetupError  naming the place, when it is none or not finite.
  double Number(const DataNode& node, const std::string& key) const;
  /// Reads all numbers of a sequence, of its rows, or of a matrix as OpenCV and ROS write it (a
  /// mapping of rows, cols and data). @throws SetupError  naming the place.
  std::vector<double> Numbers(const DataNode& node, const std::string& key) const;
};

/// Reads YAML or JSON, whose mappings must not have a key twice.
/// @throws SetupError  naming file and line; also for what is nested deeper or larger than a
/// calibration ever is.
DataFile ReadYaml(const std::filesystem::path& file);

/// Reads XML as OpenCV writes it: each element of the root by its name. @throws SetupError
DataFile ReadOpenCvXml(const std::filesystem::path& file);

/// Reads a small text file. @throws SetupError  naming it and what is wrong: it is missing, is a
/// folder, may not be read, or is larger than a calibration ever is.
std::string ReadForeignText(const std::filesystem::path& file);

/// Lists a folder's files of some kinds in the order of their names, or the one file itself; hidden
/// files are passed over. @param extensions  in small letters, with the dot.
/// @throws SetupError  when it is neither, may not be read, or holds none.
std::vector<std::filesystem::path> FilesOf(const std::filesystem::path& folder_or_file,
                                           const std::vector<std::string>& extensions);

}  // namespace mocap
