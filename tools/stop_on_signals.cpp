#include "tools/stop_on_signals.h"

#include <signal.h>

#include <atomic>
#include <cstdint>
#include <stdexcept>

#include "drivers/clock.h"

namespace mocap {
namespace {

/// `timeout` sends each signal twice: to the program and to its group.
constexpr std::int64_t kSameNs = 500'000'000;

std::atomic<int> stop_signal{0};
std::atomic<std::int64_t> stop_ns{0};

void NoteStopSignal(int number) {
  if (stop_signal.exchange(number) == 0) {
    stop_ns.store(SteadyNs());
  } else if (SteadyNs() - stop_ns.load() > kSameNs) {
    EndBySignal();
  }
}

}  // namespace

void StopOnSignals() {
  struct sigaction action {};
  action.sa_handler = NoteStopSignal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool StopAsked() { return stop_signal.load() != 0; }

void EndIfStopAsked() {
  if (StopAsked()) throw std::runtime_error("interrupted: nothing is written");
}

void EndBySignal() {
  const int number = stop_signal.load();
  if (number == 0) return;
  signal(number, SIG_DFL);
  raise(number);
}

}  // namespace mocap
