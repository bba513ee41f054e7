// mocap-witness: keypoints by a pose network. `mocap witness` runs it.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>

#include "core/errors.h"
#include "daemon/run_program.h"
#include "drivers/printable_text.h"
#include "drivers/take/input_file.h"
#include "drivers/take/keypoint_table.h"
#include "drivers/take/text_file.h"
#include "tools/remarks.h"
#include "tools/stop_on_signals.h"
#include "tools/witness/fetch_model.h"
#include "tools/witness/run_live_witness.h"
#include "tools/witness/self_test.h"
#include "tools/witness/witness_take.h"
#include "tools/witness_options.h"

namespace mocap {
namespace {

void Fetch(const WitnessOptions& options) {
  const ModelSource source = BlazePoseSource();
  const std::filesystem::path model =
      FetchModel(source, options.out.empty() ? ModelFolder() : options.out);
  std::printf(
      "%s: BlazePose (full) by the authors of MediaPipe, licence Apache-2.0, from the npm "
      "package %s, %.1f MB\n",
      Printable(model.string()).c_str(), source.package.c_str(),
      static_cast<double>(std::filesystem::file_size(model)) / 1e6);
}

/// The network that was asked for, or the fetched one.
std::filesystem::path ModelOf(const WitnessOptions& options) {
  if (!options.model.empty()) return options.model;
  const std::filesystem::path fetched = FetchedModel(ModelFolder());
  if (!IsThere(fetched))
    throw SetupError("--model is missing, and there is no " + fetched.string() +
                     "; mocap witness --fetch downloads it");
  return fetched;
}

void Live(const WitnessOptions& options) {
  if (!options.out.empty()) throw CLI::RequiredError("TAKE");
  StopOnSignals();
  const std::filesystem::path model = ModelOf(options);
  PoseNetwork network(model);
  RequireGoodAnswers(network, model);
  RunLiveWitness({.url = options.url,
                  .prefix = options.prefix,
                  .rate_hz = options.rate_hz,
                  .share = options.share_percent / 100},
                 network);
}

void Witness(const WitnessOptions& options) {
  if (options.out.empty()) throw CLI::RequiredError("--out");
  StopOnSignals();
  RequireWritable(options.out);
  const std::filesystem::path model = ModelOf(options);
  PoseNetwork network(model);
  RequireGoodAnswers(network, model);
  const Witnessed witnessed = WitnessTake({.take = options.take,
                                           .cameras = options.cameras,
                                           .people = options.people,
                                           .rate_hz = options.rate_hz},
                                          network);
  std::ostringstream text;
  WriteKeypoints(text, witnessed.views);
  ReplaceText(options.out, text.str());
  const std::size_t looks = witnessed.views.size();
  const double each_ms = looks == 0 ? 0 : 1e3 * witnessed.network_s / static_cast<double>(looks);
  std::printf("%s at people, %.0f ms each: %s\n", Counted(looks, "look").c_str(), each_ms,
              Printable(options.out.string()).c_str());
  if (witnessed.failed > 0)
    TellRemarks("witness", {"the network gave no points for " + Counted(witnessed.failed, "look")});
}

void Run(const WitnessOptions& options) {
  if (options.fetch) return Fetch(options);
  options.take.empty() ? Live(options) : Witness(options);
}

}  // namespace
}  // namespace mocap

int main(int argc, char** argv) {
  CLI::App app("Keypoints of people in pictures, by a pose network", "mocap witness");
  app.set_version_flag("--version", MOCAP_VERSION);
  mocap::WitnessOptions options;
  mocap::AddWitnessOptions(app, options);
  app.callback([&options] { mocap::Run(options); });
  const int status = mocap::RunProgram(app, argc, argv);
  if (status != 0) mocap::EndBySignal();
  return status;
}
