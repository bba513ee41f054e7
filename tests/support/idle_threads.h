// Threads of lowest priority in this process.
#pragma once

#include <sched.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace mocap::testing {

/// Waits until every other thread sleeps.
/// @return  how many of them have SCHED_IDLE.
inline int CountIdleThreads() {
  int idle = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task")) {
    const pid_t thread = std::stoi(entry.path().filename());
    while (thread != gettid()) {
      std::string line;
      std::getline(std::ifstream(entry.path() / "stat"), line);
      const std::size_t name_end = line.rfind(')');
      if (name_end == std::string::npos || line[name_end + 2] == 'S') break;
      std::this_thread::yield();
    }
    idle += sched_getscheduler(thread) == SCHED_IDLE;
  }
  return idle;
}

}  // namespace mocap::testing
