// Keeping what is written safe from a loss of power.
#pragma once

#include <filesystem>

#include "daemon/base/file_descriptor.h"

namespace mocap {

/// A file that somebody else writes, held open so that it can be kept safe. Thread-bound.
class SafeFile {
 public:
  /// @throws std::runtime_error  when it cannot be opened.
  explicit SafeFile(std::filesystem::path file);

  /// Waits until what was written so far is on the disk. @throws std::runtime_error  when it is
  /// not.
  void Sync() const;
  /// Gives back the memory that the system keeps of it.
  void Forget() const;

 private:
  std::filesystem::path file_;
  FileDescriptor descriptor_;
};

/// Waits until all that was written to a folder's file system, names included, is on the disk.
/// @throws std::runtime_error  when it is not.
void SyncFileSystem(const std::filesystem::path& folder);

}  // namespace mocap
