// mocap take import: a take of videos of phones and other cameras.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

/// @param take  the command `mocap take`.
void AddTakeImportCommand(CLI::App* take);

}  // namespace mocap
