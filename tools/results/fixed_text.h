// Numbers in tables.
#pragma once

#include <string>

namespace mocap {

/// Writes a number with so many decimals; never -0, which would make equal numbers differ. One that
/// is none is nan.
std::string FixedText(double value, int decimals);

}  // namespace mocap
