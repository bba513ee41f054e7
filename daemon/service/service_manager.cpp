#include "daemon/service/service_manager.h"

#include <systemd/sd-daemon.h>
#include <time.h>

#include <cstdint>

#include "drivers/printable_text.h"

namespace mocap {
namespace {

constexpr int kKeepEnvironment = 0;

void Notify(const std::string& state) { sd_notify(kKeepEnvironment, state.c_str()); }

}  // namespace

void ServiceManager::Ready() {
  is_ready_ = true;
  Notify("READY=1");
}

void ServiceManager::Say(const std::string& line) {
  if (line == line_) return;
  line_ = line;
  // A newline would begin another assignment.
  Notify("STATUS=" + Printable(line));
}

void ServiceManager::FeedWatchdog() { Notify("WATCHDOG=1"); }

void ServiceManager::BeginReload() {
  if (!is_ready_) return;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t now_us = now.tv_sec * 1'000'000 + now.tv_nsec / 1000;
  Notify("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(now_us));
}

void ServiceManager::EndReload() {
  if (is_ready_) Notify("READY=1");
}

void ServiceManager::Stopping(std::chrono::microseconds most) {
  Notify("STOPPING=1\nEXTEND_TIMEOUT_USEC=" + std::to_string(most.count()));
}

}  // namespace mocap
