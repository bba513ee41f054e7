// A result as OpenSim's marker table.
#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "tools/results/result.h"

namespace mocap {

/// Writes the 23 points as markers in millimetres, y up (see YUpFromWorld). The cells of a frame
/// that was not tracked are "nan", which OpenSim reads as missing.
/// @param file_name  for the header's first line.
void WriteTrc(const Result& result, const std::string& file_name, std::ostream& out);

/// Somebody whose markers stand in a table. Borrowed.
struct TrcSubject {
  std::string name;  ///< Before each marker's, with a colon; empty: nothing is.
  const Result& result;
};
/// The same of several people beside each other; where one is not known of, his cells are "nan".
/// @param rows  frames and times of the table.
void WriteTrc(std::span<const TrcSubject> subjects, const std::vector<PoseRow>& rows,
              const std::string& file_name, std::ostream& out);

}  // namespace mocap
