#include <sstream>

#include "core/errors.h"
#include "drivers/take/keypoint_table.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const mocap::testing::FuzzFile file(data, size);
  try {
    std::ostringstream again;
    mocap::WriteKeypoints(again, mocap::ReadKeypoints(file.path()));
  } catch (const mocap::SetupError&) {
    // The one way to say that a file is wrong.
  }
  return 0;
}
