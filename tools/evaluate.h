// `mocap evaluate`: compares a result with the truth.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

/// Adds the subcommand `evaluate TAKE RESULT [--report FILE.html] [--json]`.
void AddEvaluateCommand(CLI::App& app);

}  // namespace mocap
