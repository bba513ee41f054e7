// Numbers in tables.
#pragma once

#include <string>

namespace mocap {

/// Formats a number with fixed decimals. Never -0, which would make equal numbers
/// differ; nan if it is not a number.
std::string FixedText(double value, int decimals);

}  // namespace mocap
