#include "tools/stop_on_signals.h"

#include <signal.h>

namespace mocap {
namespace {

volatile sig_atomic_t stop_asked = 0;

}  // namespace

void StopOnSignals() {
  struct sigaction action {};
  action.sa_handler = [](int) { stop_asked = 1; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool StopAsked() { return stop_asked != 0; }

}  // namespace mocap
