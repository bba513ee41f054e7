#include "daemon/recording/cut_off_takes.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/errors.h"
#include "drivers/take/take_table.h"

namespace mocap {
namespace {

std::optional<CutOffTake> Describe(const std::filesystem::path& folder) {
  CutOffTake take{.folder = folder};
  std::int64_t first_ns = std::numeric_limits<std::int64_t>::max();
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".csv") continue;
    try {
      const TakeTable table = ReadTakeTable(entry.path());
      first_ns = std::min(first_ns, table.rows.front().timestamp_ns);
      take.last_ns = std::max(take.last_ns, table.rows.back().timestamp_ns);
    } catch (const SetupError&) {
      // A camera that had not delivered a frame by then.
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
  for (const auto& entry : std::filesystem::directory_iterator(takes, error)) {
    if (entry.path().extension() != ".partial" || !entry.is_directory(error)) continue;
    if (const auto take = Describe(entry.path())) found.push_back(*take);
  }
  std::ranges::sort(found, {}, &CutOffTake::folder);
  return found;
}

}  // namespace mocap
