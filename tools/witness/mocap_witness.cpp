// mocap-witness: keypoints by a pose network. `mocap witness` runs it.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <sstream>
#include <string>

#include "core/errors.h"
#include "core/people/people_capture.h"
#include "daemon/base/number_option.h"
#include "daemon/run_program.h"
#include "drivers/printable_text.h"
#include "drivers/take/keypoint_table.h"
#include "drivers/take/text_file.h"
#include "tools/stop_on_signals.h"
#include "tools/witness/self_test.h"
#include "tools/witness/witness_take.h"

namespace mocap {
namespace {

struct WitnessOptions {
  WitnessedTake wanted;
  std::filesystem::path model, out;
};

void Witness(const WitnessOptions& options) {
  StopOnSignals();
  RequireWritable(options.out);
  PoseNetwork network(options.model);
  RequireGoodAnswers(network, options.model);
  const Witnessed witnessed = WitnessTake(options.wanted, network);
  std::ostringstream text;
  WriteKeypoints(text, witnessed.views);
  ReplaceText(options.out, text.str());
  const std::size_t looks = witnessed.views.size();
  const double each_ms = looks == 0 ? 0 : 1e3 * witnessed.network_s / static_cast<double>(looks);
  std::printf("%s at people, %.0f ms each: %s\n", Counted(looks, "look").c_str(), each_ms,
              Printable(options.out.string()).c_str());
  if (witnessed.failed > 0)
    std::fprintf(stderr, "witness: the network gave no finite numbers for %s\n",
                 Counted(witnessed.failed, "look").c_str());
}

void AddOptions(CLI::App& app, WitnessOptions& options) {
  app.add_option("TAKE", options.wanted.take, "take folder")->required();
  app.add_option("--model", options.model, "network that finds a person's points, an ONNX file")
      ->required();
  app.add_option("--out", options.out, "output table of keypoints (keypoints.csv)")->required();
  app.add_option("--rate", options.wanted.rate_hz, "looks at each person per second")
      ->check(NumberFrom(0.01, 1000))
      ->capture_default_str();
  app.add_option("--people", options.wanted.people, "track up to this many people (default: one)")
      ->check(NumberFrom(1, kMostPeople));
  app.add_option("--cameras", options.wanted.cameras, "use only these cameras, such as cam1,cam2")
      ->delimiter(',');
}

}  // namespace
}  // namespace mocap

int main(int argc, char** argv) {
  CLI::App app("Keypoints of people in pictures, by a pose network", "mocap witness");
  app.set_version_flag("--version", MOCAP_VERSION);
  mocap::WitnessOptions options;
  mocap::AddOptions(app, options);
  app.callback([&options] { mocap::Witness(options); });
  const int status = mocap::RunProgram(app, argc, argv);
  if (status != 0) mocap::EndBySignal();
  return status;
}
