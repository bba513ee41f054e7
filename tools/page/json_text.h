// JSON for the page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace mocap {

using Json = nlohmann::ordered_json;

/// Converts JSON to text. Bytes in messages that are not UTF-8 become a question mark.
inline std::string JsonText(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace mocap
