#include "daemon/base/disk_space.h"

#include <sys/statvfs.h>

#include <stdexcept>

namespace mocap {

std::filesystem::path NearestFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::path place = std::filesystem::absolute(folder, error);
  while (!std::filesystem::exists(place, error) && place.has_relative_path()) {
    place = place.parent_path();
  }
  return place;
}

void RequireStillThere(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::is_directory(folder, error)) return;
  throw std::runtime_error(folder.string() +
                           " was removed or unmounted; the nearest folder that still exists is " +
                           NearestFolder(folder).string());
}

std::int64_t BytesFree(const std::filesystem::path& folder) {
  const std::filesystem::path place = NearestFolder(folder);
  struct statvfs space {};
  if (statvfs(place.c_str(), &space) != 0) return 0;
  return static_cast<std::int64_t>(space.f_bavail) * static_cast<std::int64_t>(space.f_frsize);
}

std::int64_t BytesIn(const std::filesystem::path& folder) {
  std::int64_t bytes = 0;
  std::error_code error;
  for (std::filesystem::recursive_directory_iterator entry(folder, error), end;
       !error && entry != end; entry.increment(error)) {
    std::error_code unknown;
    const std::uintmax_t size = entry->is_regular_file(unknown) ? entry->file_size(unknown) : 0;
    if (!unknown) bytes += static_cast<std::int64_t>(size);
  }
  return bytes;
}

}  // namespace mocap
