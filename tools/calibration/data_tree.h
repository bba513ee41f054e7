// A tree of YAML, JSON or OpenCV's XML: texts in sequences and mappings, with line numbers.
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
  std::vector<DataNode> items;    ///< Of a sequence, or the values of a mapping.
  std::vector<std::string> keys;  ///< Of a mapping.
  int line = 0;

  /// Finds a key of a mapping; null if there is none.
  const DataNode* Find(std::string_view key) const;
};

/// A file, parsed to a tree.
struct DataFile {
  std::filesystem::path path;
  DataNode root;

  /// Returns "file:line", for messages.
  std::string At(const DataNode& node) const;
  /// Reads a number. @throws SetupError  naming the place, when it is not a finite number.
  double Number(const DataNode& node, const std::string& key) const;
  /// Reads all numbers of a sequence, of its rows, or of a matrix as in OpenCV and ROS (a mapping
  /// of rows, cols and data). @throws SetupError  naming the place.
  std::vector<double> Numbers(const DataNode& node, const std::string& key) const;
};

/// Reads YAML or JSON; duplicate keys are errors.
/// @throws SetupError  naming file and line; also when nested deeper or larger than any
/// calibration.
DataFile ReadYaml(const std::filesystem::path& file);

/// Reads OpenCV's XML: each element of the root by its name. @throws SetupError
DataFile ReadOpenCvXml(const std::filesystem::path& file);

/// Reads a small text file. @throws SetupError  naming it and the fault: it is missing, is a
/// folder, may not be read, or is larger than any calibration.
std::string ReadForeignText(const std::filesystem::path& file);

/// Lists a folder's files with given extensions, sorted by name, or a single file. Skips hidden
/// files.
/// @param extensions  in lower case, with the dot.
/// @throws SetupError  when it is neither, may not be read, or holds none.
std::vector<std::filesystem::path> FilesOf(const std::filesystem::path& folder_or_file,
                                           const std::vector<std::string>& extensions);

}  // namespace mocap
