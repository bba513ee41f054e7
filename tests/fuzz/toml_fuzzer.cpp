#include "config/parse_toml.h"
#include "core/errors.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    mocap::ParseToml(text, "fuzz.toml");
  } catch (const mocap::SetupError&) {
    // The one way to say that a text is wrong.
  }
  return 0;
}
