// mocap: everything a person types.
#include <CLI/CLI.hpp>

#include "daemon/run_program.h"
#include "tools/background.h"
#include "tools/benchmark.h"
#include "tools/calibrate.h"
#include "tools/cameras.h"
#include "tools/control.h"
#include "tools/doctor.h"
#include "tools/evaluate.h"
#include "tools/export.h"
#include "tools/gige_studio.h"
#include "tools/simulate.h"
#include "tools/track.h"
#include "tools/watch.h"

int main(int argc, char** argv) {
  CLI::App app("Markerless motion capture: takes, calibration and the running mocapd", "mocap");
  app.require_subcommand(1);
  app.set_version_flag("--version", MOCAP_VERSION);
  mocap::AddSimulateCommand(app);
  mocap::AddTrackCommand(app);
  mocap::AddEvaluateCommand(app);
  mocap::AddExportCommand(app);
  mocap::AddBenchmarkCommand(app);
  mocap::AddCalibrateCommand(app);
  mocap::AddBackgroundCommand(app);
  mocap::AddCamerasCommand(app);
  mocap::AddGigeStudioCommand(app);
  mocap::AddControlCommands(app);
  mocap::AddWatchCommand(app);
  mocap::AddDoctorCommand(app);
  return mocap::RunProgram(app, argc, argv);
}
