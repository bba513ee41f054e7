// How a program of ours ends: exit status and the one line of an error.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

/// Parses the command line, which runs what it asks for, and turns whatever goes wrong into one
/// line on standard error and an exit status: 0 done, 1 failed while running, 2 the command line, a
/// configuration or an input file is wrong.
int RunProgram(CLI::App& app, int argc, char** argv);

}  // namespace mocap
