// Log lines that stay lines, whatever they quote.
#pragma once

#include <spdlog/formatter.h>

#include <memory>
#include <string>

namespace mocap {

/// Makes a format of spdlog in which %* is the message without control characters.
std::unique_ptr<spdlog::formatter> PrintableLogFormat(const std::string& pattern);

}  // namespace mocap
