// JSON for the page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace mocap {

/// Converts JSON to text. Bytes in messages that are not UTF-8 become a question mark.
inline std::string JsonText(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace mocap
