#include <toml++/toml.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "config/parse_toml.h"
#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_table.h"
#include "tools/import/synchronize.h"

namespace mocap {
namespace {

constexpr double kLargestOffset_s = static_cast<double>(kLongestTake_ns) / 1e9;

void AddOffset(const std::string& where, const std::string& camera, double offset_s,
               const std::vector<std::string>& cameras, std::map<std::string, double>& offsets) {
  if (std::ranges::find(cameras, camera) == cameras.end())
    throw SetupError(where + ": there is no video of a camera " + Quoted(camera) + "; " +
                     ExpectedNames(camera, cameras));
  if (!std::isfinite(offset_s) || std::abs(offset_s) > kLargestOffset_s)
    throw SetupError(where + ": the offset of " + camera + " is not a time in seconds");
  if (!offsets.emplace(camera, offset_s).second)
    throw SetupError(where + ": names " + camera + " twice");
}

std::map<std::string, double> ReadOffsets(const std::filesystem::path& file,
                                          const std::vector<std::string>& cameras) {
  std::map<std::string, double> offsets;
  for (const auto& [key, value] : ParseTomlFile(file)) {
    const std::optional<double> offset_s = value.value<double>();
    if (!offset_s)
      throw SetupError(file.string() + ": " + std::string(key.str()) +
                       " is not a number; expected seconds");
    AddOffset(file.string(), std::string(key.str()), *offset_s, cameras, offsets);
  }
  return offsets;
}

}  // namespace

std::map<std::string, double> ParseOffsets(const std::string& text,
                                           const std::vector<std::string>& cameras) {
  if (text.find('=') == std::string::npos) return ReadOffsets(text, cameras);
  std::map<std::string, double> offsets;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t sign = part.find('=');
    double offset_s = 0;
    const char* end = part.data() + part.size();
    const char* begin = sign == std::string::npos ? end : part.data() + sign + 1;
    if (begin != end && *begin == '+') ++begin;
    const auto parsed = std::from_chars(begin, end, offset_s);
    if (begin == end || parsed.ec != std::errc() || parsed.ptr != end)
      throw SetupError("--offsets " + Quoted(part) +
                       ": expected CAMERA=SECONDS, such as cam2=-0.35, or a file");
    AddOffset("--offsets", part.substr(0, sign), offset_s, cameras, offsets);
  }
  return offsets;
}

}  // namespace mocap
