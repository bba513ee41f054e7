// `mocap compare`: a result beside markers, or another recording of the same motion.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

/// Adds the subcommand `compare RESULT OTHER [--map TOML] [--report HTML] [--person NAME]
/// [--subject NAME] [--prefix NAME] [--json]`.
void AddCompareCommand(CLI::App& app);

}  // namespace mocap
