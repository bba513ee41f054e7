#include "tools/witness_options.h"

#include "core/people/people_capture.h"
#include "daemon/base/number_option.h"

namespace mocap {

void AddWitnessOptions(CLI::App& command, WitnessOptions& options) {
  CLI::Option* take =
      command.add_option("TAKE", options.take, "take folder (default: live, what mocapd sees)");
  CLI::Option* model = command.add_option(
      "--model", options.model,
      "network that finds a person's points, an ONNX file (default: the fetched one)");
  command.add_option(
      "--out", options.out,
      "output table of keypoints (keypoints.csv); with --fetch, the network's folder");
  command.add_option("--rate", options.rate_hz, "looks at each person per second")
      ->check(NumberFrom(0.01, 1000))
      ->capture_default_str();
  command.add_option("--people", options.people, "track up to this many people (default: one)")
      ->check(NumberFrom(1, kMostPeople))
      ->needs(take);
  command.add_option("--cameras", options.cameras, "use only these cameras, such as cam1,cam2")
      ->delimiter(',')
      ->needs(take);
  command
      .add_option("--share", options.share_percent,
                  "live: percent of one processor's time that it may use at most")
      ->check(NumberFrom(0.1, 100))
      ->capture_default_str()
      ->excludes(take);
  command.add_option("--url", options.url, "live: LCM URL")->capture_default_str()->excludes(take);
  command.add_option("--prefix", options.prefix, "live: prefix of the LCM channel names")
      ->excludes(take);
  command
      .add_flag("--fetch", options.fetch,
                "download a network, MediaPipe's BlazePose (Apache-2.0), by npm, and convert it")
      ->excludes(take)
      ->excludes(model);
}

}  // namespace mocap
