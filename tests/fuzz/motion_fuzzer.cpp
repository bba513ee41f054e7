// Every reader of other programs' motion, on the same bytes.
#include <cstdint>
#include <string_view>

#include "core/errors.h"
#include "tests/fuzz/fuzz_file.h"
#include "tools/comparison/c3d_file.h"
#include "tools/comparison/text_motion.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const mocap::testing::FuzzFile file(data, size);
  for (const auto read : {mocap::ReadTrc, mocap::ReadMot, mocap::ReadBvh, mocap::ReadCsvMotion}) {
    try {
      read(file.path());
    } catch (const mocap::SetupError&) {
      // The one way to say that a file is wrong.
    }
  }
  try {
    mocap::ParseC3d({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const mocap::SetupError&) {
  }
  return 0;
}
