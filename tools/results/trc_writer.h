// A result as OpenSim's marker table.
#pragma once

#include <iosfwd>
#include <string>

#include "tools/results/result.h"

namespace mocap {

/// Writes the 23 points as markers in millimetres, y up (see YUpFromWorld). The cells of a frame
/// that was not tracked are "nan", which OpenSim reads as missing.
/// @param file_name  for the header's first line.
void WriteTrc(const Result& result, const std::string& file_name, std::ostream& out);

}  // namespace mocap
