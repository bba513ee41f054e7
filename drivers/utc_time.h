// Times as text in files: "2026-11-21T20:05:00Z".
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace mocap {

/// Formats a time, to the second. @param epoch_s  since the Unix epoch.
std::string UtcText(std::int64_t epoch_s);

/// Parses the format of UtcText; empty for anything else.
std::optional<std::int64_t> UtcFromText(const std::string& text);

}  // namespace mocap
