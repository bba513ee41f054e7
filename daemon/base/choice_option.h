// Choices on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "drivers/nearest_name.h"
#include "drivers/quoted.h"

namespace mocap {

/// Accepts one of several names. The error message has the name that a misspelt one resembles.
inline CLI::Validator OneOf(const std::vector<std::string>& names) {
  const auto check = [names](const std::string& text) {
    if (std::ranges::find(names, text) != names.end()) return std::string();
    return Quoted(text) + " is unknown; " + ExpectedNames(text, names);
  };
  return CLI::Validator(check, "{" + CLI::detail::join(names) + "}");
}

}  // namespace mocap
