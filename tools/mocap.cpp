// mocap: the command-line program.
#include <CLI/CLI.hpp>

#include "daemon/run_program.h"
#include "tools/commands.h"

int main(int argc, char** argv) {
  CLI::App app("Markerless motion capture: the running daemon, takes and calibration", "mocap");
  app.require_subcommand(1);
  app.set_version_flag("--version", MOCAP_VERSION);
  mocap::AddCommands(app);
  return mocap::RunProgram(app, argc, argv);
}
