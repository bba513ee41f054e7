// A folder for files that are needed only for a while.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "drivers/take/unfinished_folder.h"

namespace mocap {

/// A new folder among the system's temporary files (TMPDIR), removed with its contents at the end.
class WorkFolder {
 public:
  /// @throws std::runtime_error  when it cannot be made.
  WorkFolder() : path_(Make()), removed_(path_) {}

  const std::filesystem::path& path() const { return path_; }

 private:
  static std::filesystem::path Make() {
    std::string name = std::filesystem::temp_directory_path() / "mocap-XXXXXX";
    if (!mkdtemp(name.data())) throw std::runtime_error(name + ": cannot be created");
    return name;
  }

  const std::filesystem::path path_;
  const UnfinishedFolder removed_;
};

}  // namespace mocap
