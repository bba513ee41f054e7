// mocap: the command-line program.
#include <CLI/CLI.hpp>

#include "daemon/run_program.h"
#include "tools/commands.h"
#include "tools/stop_on_signals.h"

int main(int argc, char** argv) {
  CLI::App app("Markerless motion capture: the running daemon, takes and calibration", "mocap");
  app.require_subcommand(1);
  app.set_version_flag("--version", MOCAP_VERSION);
  mocap::AddCommands(app);
  const int status = mocap::RunProgram(app, argc, argv);
  if (status != 0) mocap::EndBySignal();
  return status;
}
