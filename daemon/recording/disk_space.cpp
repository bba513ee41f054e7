#include "daemon/recording/disk_space.h"

#include <sys/statvfs.h>

namespace mocap {

std::int64_t BytesFree(const std::filesystem::path& folder) {
  std::filesystem::path place = folder;
  std::error_code error;
  while (!std::filesystem::exists(place, error) && place.has_relative_path()) {
    place = place.parent_path();
  }
  struct statvfs space {};
  if (statvfs(place.c_str(), &space) != 0) return 0;
  return static_cast<std::int64_t>(space.f_bavail) * static_cast<std::int64_t>(space.f_frsize);
}

}  // namespace mocap
