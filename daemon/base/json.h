// JSON, for other programs and for the page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace mocap {

/// Members keep the order in which they are added.
using Json = nlohmann::ordered_json;

/// A number with so many decimals, or without any if it is whole.
/// @pre  the number is finite.
Json Rounded(double value, int decimals);

/// Converts JSON to one line. What a terminal might interpret is escaped; bytes that are not UTF-8
/// become U+FFFD.
std::string JsonText(const Json& json);

}  // namespace mocap
