#include "daemon/service/stop_signals.h"

#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <cstring>

#include "drivers/clock.h"

namespace mocap {
namespace {

constexpr timespec kSignalTick{0, 50'000'000};
constexpr int kFailed = 1;

sigset_t HeldSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  return signals;
}

}  // namespace

void HoldSignals() {
  const sigset_t signals = HeldSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);
}

StopSignals::StopSignals() : thread_([this] { Run(); }) {}

StopSignals::~StopSignals() {
  is_over_.store(true);
  thread_.join();
}

void StopSignals::Wait(std::chrono::nanoseconds most) {
  std::unique_lock lock(mutex_);
  news_.wait_for(lock, most, [this] { return has_news_; });
  has_news_ = false;
}

void StopSignals::Run() {
  pthread_setname_np(pthread_self(), "signals");
  const sigset_t signals = HeldSignals();
  while (!is_over_.load()) {
    const int signal = sigtimedwait(&signals, nullptr, &kSignalTick);
    if (signal == SIGHUP) reload_.store(true);
    if (signal == SIGINT || signal == SIGTERM) NoteStop();
    if (signal > 0) {
      const std::scoped_lock lock(mutex_);
      has_news_ = true;
      news_.notify_all();
    }
    if (!stop_.load() || SteadyNs() - stop_ns_ < patience_ns_.load()) continue;
    EndNow();
  }
}

// `timeout` sends each signal twice: to the program and to its group.
void StopSignals::NoteStop() {
  constexpr std::int64_t kSameNs = 500'000'000;
  if (!stop_.exchange(true)) {
    stop_ns_ = SteadyNs();
  } else if (SteadyNs() - stop_ns_ > kSameNs) {
    EndNow();
  }
}

// Uses nothing that could hang too: no destructors, no log.
void StopSignals::EndNow() const {
  const char* line = "mocapd: stopped without waiting for threads that hang\n";
  if (is_starting_.load()) line = "mocapd: stopped while starting\n";
  if (has_take_.load()) {
    line =
        "mocapd: stopped before the recording was complete; what is incomplete keeps .partial in "
        "its name\n";
  }
  pollfd room{STDERR_FILENO, POLLOUT, 0};
  if (poll(&room, 1, 0) == 1) {
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, line, std::strlen(line));
  }
  _exit(has_take_.load() ? kFailed : 0);
}

}  // namespace mocap
