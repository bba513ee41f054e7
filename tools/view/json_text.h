// JSON for the page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace mocap {

/// As text; what is no UTF-8 in messages of others becomes a question mark.
inline std::string JsonText(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace mocap
