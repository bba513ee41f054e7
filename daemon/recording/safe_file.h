// Protects written files from power loss.
#pragma once

#include <filesystem>

#include "daemon/base/file_descriptor.h"

namespace mocap {

/// A file that others write, held open for syncing. Thread-bound.
class SafeFile {
 public:
  /// @throws std::runtime_error  if it cannot be opened.
  explicit SafeFile(std::filesystem::path file);

  /// Waits until everything written so far is on the disk. @throws std::runtime_error  on failure.
  void Sync() const;
  /// Drops its pages from the system's cache.
  void Forget() const;

 private:
  std::filesystem::path file_;
  FileDescriptor descriptor_;
};

/// Waits until everything written to a folder's file system, including names, is on the disk.
/// @throws std::runtime_error  on failure.
void SyncFileSystem(const std::filesystem::path& folder);

}  // namespace mocap
