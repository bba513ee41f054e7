// mocap status, record, subject, reload: commands to the running daemon.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

namespace mocap {

/// Sends a request to the daemon and prints its answer.
/// @param socket  empty: the system's daemon, or the user's own.
/// @throws SetupError, std::runtime_error  for a refusal or failure.
void AskAndPrint(const std::filesystem::path& socket, const std::string& request);

void AddControlCommands(CLI::App& app);

}  // namespace mocap
