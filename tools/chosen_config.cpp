#include "tools/chosen_config.h"

#include "config/load_config.h"
#include "drivers/take/input_file.h"

namespace mocap {

std::filesystem::path SystemConfig() {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  const std::filesystem::path prefix = program.parent_path().parent_path();
  return (prefix == "/usr" ? "/" : prefix) / MOCAP_SYSCONFDIR / "mocapd" / "mocapd.toml";
}

Config LoadChosenConfig(const std::filesystem::path& named) {
  if (!named.empty()) return LoadConfig(named);
  return IsThere(SystemConfig()) ? LoadConfig(SystemConfig()) : Config();
}

}  // namespace mocap
