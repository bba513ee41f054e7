#include "daemon/base/json.h"

#include <cmath>
#include <cstdint>

#include "core/errors.h"

namespace mocap {

Json Rounded(double value, int decimals) {
  MOCAP_CHECK(std::isfinite(value));
  const double scale = std::pow(10, decimals);
  const double rounded = std::round(value * scale) / scale;
  const bool is_whole = rounded == std::trunc(rounded) && std::abs(rounded) < 1e15;
  return is_whole ? Json(static_cast<std::int64_t>(rounded)) : Json(rounded);
}

std::string JsonText(const Json& json) {
  constexpr bool kOnlyAscii = true;
  return json.dump(-1, ' ', kOnlyAscii, Json::error_handler_t::replace);
}

}  // namespace mocap
