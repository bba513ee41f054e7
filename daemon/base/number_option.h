// Numbers on the command line.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace mocap {

/// Accepts numbers within bounds. The error message names these bounds; CLI11's own message would
/// print the limits of the number type.
inline CLI::Validator NumberFrom(double least, double most) {
  const std::string bounds = fmt::format("from {} to {}", least, most);
  const auto check = [least, most, bounds](const std::string& text) {
    double value = 0;
    if (!CLI::detail::lexical_cast(text, value)) return "expected a number " + bounds;
    const bool is_within = std::isfinite(value) && value >= least && value <= most;
    return is_within ? std::string()
                     : text.substr(0, 40) + " is out of range; expected a number " + bounds;
  };
  return CLI::Validator(check, bounds);
}

}  // namespace mocap
