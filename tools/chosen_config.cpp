#include "tools/chosen_config.h"

#include "config/load_config.h"
#include "drivers/take/input_file.h"

namespace mocap {

Config LoadChosenConfig(const std::filesystem::path& named) {
  if (!named.empty()) return LoadConfig(named);
  return IsThere(kSystemConfig) ? LoadConfig(kSystemConfig) : Config();
}

}  // namespace mocap
