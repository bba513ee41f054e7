#include "daemon/recording/safe_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace mocap {
namespace {

void Check(bool is_good, const std::filesystem::path& path) {
  if (is_good) return;
  throw std::runtime_error(path.string() + ": cannot be flushed to the disk: " +
                           std::strerror(errno) + "; check the disk");
}

FileDescriptor OpenToSync(const std::filesystem::path& path) {
  FileDescriptor descriptor(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  Check(descriptor.valid(), path);
  return descriptor;
}

}  // namespace

SafeFile::SafeFile(std::filesystem::path file)
    : file_(std::move(file)), descriptor_(OpenToSync(file_)) {}

void SafeFile::Sync() const { Check(fdatasync(descriptor_.get()) == 0, file_); }

void SafeFile::Forget() const { posix_fadvise(descriptor_.get(), 0, 0, POSIX_FADV_DONTNEED); }

void SyncFileSystem(const std::filesystem::path& folder) {
  Check(syncfs(OpenToSync(folder).get()) == 0, folder);
}

}  // namespace mocap
