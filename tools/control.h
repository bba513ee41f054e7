// mocap status, record, subject, reload: what a person tells the running daemon.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

namespace mocap {

/// Asks the daemon and prints its answer.
/// @param socket  empty: the system's daemon, or the user's own.
/// @throws SetupError, std::runtime_error  for what was refused or failed.
void AskAndPrint(const std::filesystem::path& socket, const std::string& request);

void AddControlCommands(CLI::App& app);

}  // namespace mocap
