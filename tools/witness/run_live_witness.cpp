#include "tools/witness/run_live_witness.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "core/errors.h"
#include "daemon/messages/silence.h"
#include "drivers/clock.h"
#include "drivers/go_behind.h"
#include "drivers/printable_text.h"
#include "tools/remarks.h"
#include "tools/stop_on_signals.h"
#include "tools/stream/message_source.h"

namespace mocap {
namespace {

constexpr std::chrono::milliseconds kWaitForLooks{20};
constexpr int kMostHandledAtOnce = 256;
constexpr std::int64_t kSilent_ns = 3'000'000'000;
constexpr std::int64_t kTell_ns = 3'000'000'000;

/// What happened since the last line.
void TellLooks(const LiveWitnessCount& before, const LiveWitnessCount& now, std::int64_t span_ns,
               std::size_t people) {
  const auto looks = static_cast<double>(now.looks - before.looks);
  const auto cpu_ns = static_cast<double>(now.cpu_ns - before.cpu_ns);
  const auto span = static_cast<double>(span_ns);
  std::printf("%s, %.1f looks/s, %.0f ms each, %.0f %% of a processor\n",
              people == 1 ? "1 person" : (std::to_string(people) + " people").c_str(),
              1e9 * looks / span, 1e-6 * cpu_ns / std::max(1.0, looks), 100 * cpu_ns / span);
  std::fflush(stdout);
}

/// Says once that nothing is heard, until something is.
class SilenceTeller {
 public:
  SilenceTeller(lcm::LCM& lcm, const LiveWitnessOptions& options)
      : silence_(lcm, options.url, options.prefix) {}

  void Tell(bool is_silent) {
    if (is_silent && !was_silent_) TellRemarks("witness", {silence_.Text()});
    was_silent_ = is_silent;
  }

 private:
  const Silence silence_;
  bool was_silent_ = false;
};

}  // namespace

void RunLiveWitness(const LiveWitnessOptions& options, PoseNetwork& network) {
  MessageSource source(options.url);
  if (source.is_log()) throw SetupError("--url: " + options.url + " is a log; expected a live one");
  LiveWitness witness(source.lcm(), options, network);
  SilenceTeller teller(source.lcm(), options);
  GoBehind("mocap-witness");
  const bool on_terminal = isatty(STDOUT_FILENO) == 1;
  LiveWitnessCount told;
  std::int64_t told_ns = SteadyNs();
  while (!StopAsked()) {
    source.Handle(kWaitForLooks);
    // What came while the network computed.
    for (int i = 0; i < kMostHandledAtOnce && source.lcm().handleTimeout(0) > 0; ++i) continue;
    const std::int64_t now_ns = SteadyNs();
    witness.Work(now_ns);
    teller.Tell(now_ns - witness.heard_ns() > kSilent_ns);
    if (!on_terminal || now_ns - told_ns < kTell_ns) continue;
    TellLooks(told, witness.count(), now_ns - told_ns, witness.people());
    told = witness.count();
    told_ns = now_ns;
  }
  witness.End();
}

}  // namespace mocap
