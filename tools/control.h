// mocap status, record, subject, reload: what a person tells the running daemon.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddControlCommands(CLI::App& app);

}  // namespace mocap
