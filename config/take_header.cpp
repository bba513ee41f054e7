#include "config/take_header.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "config/toml_section.h"
#include "core/errors.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"

namespace mocap {
namespace {

/// Whether `mocap track` wrote the folder, for one person or several.
bool IsResult(const std::filesystem::path& folder) {
  if (IsThere(folder / "poses.csv")) return true;
  std::error_code error;  // A folder that cannot be listed may be a take.
  for (std::filesystem::directory_iterator entry(folder, error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const bool is_person = entry->path().filename().native().starts_with("person-");
    if (is_person && IsThere(entry->path() / "poses.csv")) return true;
  }
  return false;
}

}  // namespace

TakeHeader ReadTakeHeader(const std::filesystem::path& take) {
  const TakeLayout layout{take};
  const std::filesystem::path folder = take.has_parent_path() ? take.parent_path() : ".";
  if (std::filesystem::is_regular_file(take) && IsThere(TakeLayout{folder}.Description()))
    throw SetupError(take.string() + ": is a file of a take; expected its folder, " +
                     folder.string());
  RequireFolder(take, "a take");
  if (!IsThere(layout.Description()) && IsResult(take)) {
    throw SetupError(take.string() +
                     ": is a result of tracking, not a take; expected a folder with take.toml");
  }
  TomlSection section = TomlSection::ReadFile(layout.Description());
  TakeHeader header;
  header.name = section.Text("name");
  header.fps_nominal = section.NumberWithin("fps_nominal", 0.1, 10000);
  header.cameras = section.Texts("cameras");
  if (section.Has("begin_ns"))
    header.begin_ns =
        section.IntegerWithin("begin_ns", 0, std::numeric_limits<std::int64_t>::max());
  if (header.cameras.empty()) section.Fail("cameras", "is empty; expected names of cameras");
  for (const std::string& name : header.cameras) {
    if (!IsCameraName(name)) {
      section.Fail("cameras", "has a name that is not made of letters, digits, _ and -");
    }
    if (std::count(header.cameras.begin(), header.cameras.end(), name) > 1) {
      section.Fail("cameras", "has \"" + name + "\" twice");
    }
  }
  return header;
}

}  // namespace mocap
