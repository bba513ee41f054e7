#include "daemon/base/service_folders.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>

#include "daemon/base/disk_space.h"
#include "daemon/base/file_descriptor.h"

namespace mocap {

std::filesystem::path StateFolder() {
  if (const char* folder = std::getenv("STATE_DIRECTORY")) return folder;
  if (const char* folder = std::getenv("XDG_STATE_HOME")) {
    return std::filesystem::path(folder) / "mocapd";
  }
  const char* home = std::getenv("HOME");
  return home ? std::filesystem::path(home) / ".local/state/mocapd" : ".";
}

std::filesystem::path LogsFolder() {
  const char* folder = std::getenv("LOGS_DIRECTORY");
  return folder ? folder : "";
}

std::int64_t WrittenAt(const std::filesystem::path& file) {
  std::error_code error;
  const auto time = std::filesystem::last_write_time(file, error);
  if (error) return 0;
  const auto since = std::chrono::file_clock::to_sys(time).time_since_epoch();
  return std::chrono::duration_cast<std::chrono::seconds>(since).count();
}

std::string WhyNotWritable(const std::filesystem::path& folder) {
  const std::filesystem::path place = NearestFolder(folder);
  std::error_code error;
  if (!std::filesystem::is_directory(place, error)) return place.string() + " is not a folder";
  // Only an attempt to write reveals a read-only file system, or a folder of the kernel.
  std::string name = (place / ".mocapd-XXXXXX").string();
  const FileDescriptor file(mkostemp(name.data(), O_CLOEXEC));
  if (!file.valid()) {
    return errno == ENOSPC || errno == EDQUOT ? "" : place.string() + ": " + std::strerror(errno);
  }
  unlink(name.c_str());
  return "";
}

}  // namespace mocap
