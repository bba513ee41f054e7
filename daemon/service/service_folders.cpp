#include "daemon/service/service_folders.h"

#include <cstdlib>

namespace mocap {

std::filesystem::path StateFolder() {
  if (const char* folder = std::getenv("STATE_DIRECTORY")) return folder;
  if (const char* folder = std::getenv("XDG_STATE_HOME")) {
    return std::filesystem::path(folder) / "mocapd";
  }
  const char* home = std::getenv("HOME");
  return home ? std::filesystem::path(home) / ".local/state/mocapd" : ".";
}

std::filesystem::path LogsFolder() {
  const char* folder = std::getenv("LOGS_DIRECTORY");
  return folder ? folder : "";
}

}  // namespace mocap
