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

constexpr timespec kTick{0, 50'000'000};
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
    const int signal = sigtimedwait(&signals, nullptr, &kTick);
    if (signal == SIGHUP) reload_.store(true);
    if (signal == SIGINT || signal == SIGTERM) NoteStop();
    if (signal > 0) {
      const std::scoped_lock lock(mutex_);
      has_news_ = true;
      news_.notify_all();
    }
    if (!stop_.load() || SteadyNs() - stop_ns_ < patience_ns_.load()) continue;
    // What was begun while the daemon starts can be begun again.
    if (is_starting_.load()) EndNow("ended while it was starting", 0);
    EndNow("did not come to its end in time; a take that was recorded keeps .partial in its name",
           kFailed);
  }
}

// `timeout` sends every signal twice: to the program and to its group.
void StopSignals::NoteStop() {
  constexpr std::int64_t kSameNs = 500'000'000;
  if (!stop_.exchange(true)) {
    stop_ns_ = SteadyNs();
  } else if (SteadyNs() - stop_ns_ > kSameNs) {
    EndNow("ended at once; a take that was recorded keeps .partial in its name", kFailed);
  }
}

// Nothing that could hang as well: no destructors, no log.
void StopSignals::EndNow(const char* why, int status) {
  char line[160] = "mocapd: ";
  std::strncat(line, why, sizeof line - std::strlen(line) - 2);
  std::strcat(line, "\n");
  pollfd room{STDERR_FILENO, POLLOUT, 0};
  if (poll(&room, 1, 0) == 1) {
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, line, std::strlen(line));
  }
  _exit(status);
}

}  // namespace mocap
