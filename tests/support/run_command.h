// A command of mocap, run in the test's own process.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace mocap::testing {

/// Runs one command as a person would type it.
///
/// @param add  adds the command to the program.
inline void RunCommand(void (*add)(CLI::App&), const std::string& command_line) {
  CLI::App app("mocap");
  add(app);
  app.parse(command_line);
}

}  // namespace mocap::testing
