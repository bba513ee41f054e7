#include "drivers/utc_time.h"

#include <ctime>

namespace mocap {
namespace {

constexpr const char* kFormat = "%Y-%m-%dT%H:%M:%SZ";

}  // namespace

std::string UtcText(std::int64_t epoch_s) {
  const std::time_t time = epoch_s;
  std::tm utc{};
  gmtime_r(&time, &utc);
  char text[32];
  std::strftime(text, sizeof text, kFormat, &utc);
  return text;
}

std::optional<std::int64_t> UtcFromText(const std::string& text) {
  std::tm utc{};
  const char* end = strptime(text.c_str(), kFormat, &utc);
  if (end == nullptr || *end != '\0') return std::nullopt;
  return timegm(&utc);
}

}  // namespace mocap
