// Keeps each log message on one line, whatever it quotes.
#pragma once

#include <spdlog/formatter.h>

#include <memory>
#include <string>

namespace mocap {

/// Makes an spdlog formatter in which %* is the message without control characters.
std::unique_ptr<spdlog::formatter> PrintableLogFormat(const std::string& pattern);

}  // namespace mocap
