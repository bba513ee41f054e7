#include "core/errors.h"
#include "tests/fuzz/fuzz_file.h"
#include "tools/results/people_log.h"
#include "tools/results/pose_log.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const mocap::testing::FuzzFile file(data, size);
  try {
    mocap::ReadPoseLog(file.path(), {});
  } catch (const mocap::SetupError&) {
    // The one way to say that a log cannot be used.
  }
  try {
    mocap::ReadPeopleLog(file.path(), {});
  } catch (const mocap::SetupError&) {
  }
  return 0;
}
