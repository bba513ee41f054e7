// Runs a program and reports errors: exit status and one line.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

/// Parses the command line, which runs the requested command. Turns any error into one line on
/// standard error and an exit status: 0 success, 1 failed while running, 2 invalid command line,
/// configuration or input file.
int RunProgram(CLI::App& app, int argc, char** argv);

}  // namespace mocap
