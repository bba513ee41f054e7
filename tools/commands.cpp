#include "tools/commands.h"

#include "tools/ask.h"
#include "tools/background.h"
#include "tools/benchmark.h"
#include "tools/calibrate.h"
#include "tools/cameras.h"
#include "tools/compare.h"
#include "tools/control.h"
#include "tools/doctor.h"
#include "tools/evaluate.h"
#include "tools/export.h"
#include "tools/gait.h"
#include "tools/gige_studio.h"
#include "tools/simulate.h"
#include "tools/solve.h"
#include "tools/stream.h"
#include "tools/take.h"
#include "tools/track.h"
#include "tools/view.h"
#include "tools/watch.h"
#include "tools/witness.h"

namespace mocap {

void AddCommands(CLI::App& app) {
  AddSimulateCommand(app);
  AddTakeCommand(app);
  AddTrackCommand(app);
  AddSolveCommand(app);
  AddWitnessCommand(app);
  AddEvaluateCommand(app);
  AddCompareCommand(app);
  AddGaitCommand(app);
  AddExportCommand(app);
  AddBenchmarkCommand(app);
  AddCalibrateCommand(app);
  AddBackgroundCommand(app);
  AddCamerasCommand(app);
  AddGigeStudioCommand(app);
  AddControlCommands(app);
  AddAskCommand(app);
  AddViewCommand(app);
  AddStreamCommand(app);
  AddWatchCommand(app);
  AddDoctorCommand(app);
}

}  // namespace mocap
