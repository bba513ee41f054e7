// mocap-witness: keypoints by a pose network. `mocap witness` runs it.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>

#include "core/errors.h"
#include "core/people/people_capture.h"
#include "daemon/base/number_option.h"
#include "daemon/run_program.h"
#include "drivers/printable_text.h"
#include "drivers/take/input_file.h"
#include "drivers/take/keypoint_table.h"
#include "drivers/take/text_file.h"
#include "tools/remarks.h"
#include "tools/stop_on_signals.h"
#include "tools/witness/fetch_model.h"
#include "tools/witness/self_test.h"
#include "tools/witness/witness_take.h"

namespace mocap {
namespace {

struct WitnessOptions {
  WitnessedTake wanted;
  std::filesystem::path model, out;
  bool fetch = false;
};

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

void Witness(const WitnessOptions& options) {
  if (options.wanted.take.empty()) throw CLI::RequiredError("TAKE");
  if (options.out.empty()) throw CLI::RequiredError("--out");
  StopOnSignals();
  RequireWritable(options.out);
  const std::filesystem::path model = ModelOf(options);
  PoseNetwork network(model);
  RequireGoodAnswers(network, model);
  const Witnessed witnessed = WitnessTake(options.wanted, network);
  std::ostringstream text;
  WriteKeypoints(text, witnessed.views);
  ReplaceText(options.out, text.str());
  const std::size_t looks = witnessed.views.size();
  const double each_ms = looks == 0 ? 0 : 1e3 * witnessed.network_s / static_cast<double>(looks);
  std::printf("%s at people, %.0f ms each: %s\n", Counted(looks, "look").c_str(), each_ms,
              Printable(options.out.string()).c_str());
  if (witnessed.failed > 0)
    TellRemarks("witness",
                {"the network gave no finite numbers for " + Counted(witnessed.failed, "look")});
}

void AddOptions(CLI::App& app, WitnessOptions& options) {
  CLI::Option* take = app.add_option("TAKE", options.wanted.take, "take folder");
  CLI::Option* model = app.add_option(
      "--model", options.model,
      "network that finds a person's points, an ONNX file (default: the fetched one)");
  app.add_option("--out", options.out,
                 "output table of keypoints (keypoints.csv); with --fetch, the network's folder");
  app.add_option("--rate", options.wanted.rate_hz, "looks at each person per second")
      ->check(NumberFrom(0.01, 1000))
      ->capture_default_str();
  app.add_option("--people", options.wanted.people, "track up to this many people (default: one)")
      ->check(NumberFrom(1, kMostPeople));
  app.add_option("--cameras", options.wanted.cameras, "use only these cameras, such as cam1,cam2")
      ->delimiter(',');
  app.add_flag("--fetch", options.fetch,
               "download a network, MediaPipe's BlazePose (Apache-2.0), by npm, and convert it")
      ->excludes(take)
      ->excludes(model);
}

}  // namespace
}  // namespace mocap

int main(int argc, char** argv) {
  CLI::App app("Keypoints of people in pictures, by a pose network", "mocap witness");
  app.set_version_flag("--version", MOCAP_VERSION);
  mocap::WitnessOptions options;
  mocap::AddOptions(app, options);
  app.callback([&options] { options.fetch ? mocap::Fetch(options) : mocap::Witness(options); });
  const int status = mocap::RunProgram(app, argc, argv);
  if (status != 0) mocap::EndBySignal();
  return status;
}
