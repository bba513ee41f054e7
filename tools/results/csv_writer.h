// A result as one table for spreadsheets and scripts.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>

#include "tools/results/result.h"

namespace mocap {

/// Writes one row a frame: time_s since the first frame, utime_us since the epoch, state, the
/// paper's 23 numbers and the 23 points in the world frame. Cells of what was not known are empty.
/// @param first_ns  when time_s is 0; without it, at the first frame.
void WriteCsv(const Result& result, std::ostream& out, std::optional<std::int64_t> first_ns = {});

}  // namespace mocap
