// Stops one thread of a running program for good, as a driver does that never comes back.
// usage: hang_thread PID NAME
#include <dirent.h>
#include <sys/ptrace.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string tasks = std::string("/proc/") + argv[1] + "/task/";
  DIR* folder = opendir(tasks.c_str());
  if (!folder) return 2;
  while (const dirent* entry = readdir(folder)) {
    std::ifstream in(tasks + entry->d_name + "/comm");
    std::string name;
    if (!std::getline(in, name) || name != argv[2]) continue;
    const int thread = std::atoi(entry->d_name);
    if (ptrace(PTRACE_SEIZE, thread, nullptr, nullptr) != 0) return 1;
    if (ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr) != 0) return 1;
    std::printf("%s hangs\n", argv[2]);
    std::fflush(stdout);
    // It runs on when its tracer ends.
    pause();
  }
  return 1;
}
