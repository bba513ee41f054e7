#include "tools/gige/own_config.h"

#include <fmt/format.h>

#include "config/parse_toml.h"
#include "core/errors.h"
#include "drivers/take/input_file.h"
#include "tools/checksum.h"

namespace mocap {

std::string SignedConfig(const std::string& text) {
  return fmt::format(
             "# Written by mocap gige-studio, as {:016x}: rename it before you change it.\n",
             Fnv1a(text)) +
         text;
}

void RequireOwnConfig(const std::filesystem::path& file) {
  if (!IsThere(file)) return;
  const std::string text = ReadTomlText(file);
  if (text.empty()) return;
  const std::size_t end = text.find('\n');
  if (end != std::string::npos && SignedConfig(text.substr(end + 1)) == text) return;
  throw SetupError(
      file.string() +
      ": exists and is not as mocap gige-studio wrote it; expected the name of a new file");
}

}  // namespace mocap
