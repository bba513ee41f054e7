#include "daemon/recording/cut_off_takes.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>

#include "drivers/take/take_table.h"

namespace mocap {
namespace {

/// The visible files. Tolerates concurrent changes by others.
std::vector<std::filesystem::path> FilesIn(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    files.push_back(entry->path());
  }
  return files;
}

std::optional<CutOffTake> Describe(const std::filesystem::path& folder) {
  CutOffTake take{.folder = folder};
  std::int64_t first_ns = std::numeric_limits<std::int64_t>::max();
  for (const std::filesystem::path& file : FilesIn(folder)) {
    if (file.extension() != ".csv") continue;
    try {
      const TakeTable table = ReadTakeTable(file);
      first_ns = std::min(first_ns, table.rows.front().timestamp_ns);
      take.last_ns = std::max(take.last_ns, table.rows.back().timestamp_ns);
    } catch (const std::runtime_error&) {
      // The camera had not delivered a frame yet, or the table cannot be read.
    }
  }
  if (take.last_ns == 0) return {};
  take.duration_ns = take.last_ns - first_ns;
  return take;
}

}  // namespace

std::vector<CutOffTake> FindCutOffTakes(const std::filesystem::path& takes) {
  std::vector<CutOffTake> found;
  std::error_code error;
  for (const std::filesystem::path& folder : FilesIn(takes)) {
    if (folder.extension() != ".partial" || !std::filesystem::is_directory(folder, error)) continue;
    if (const auto take = Describe(folder)) found.push_back(*take);
  }
  std::ranges::sort(found, {}, &CutOffTake::folder);
  return found;
}

}  // namespace mocap
