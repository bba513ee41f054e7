// Every reader of other programs' calibrations, on the same bytes.
#include <array>

#include "core/errors.h"
#include "tests/fuzz/fuzz_file.h"
#include "tools/calibration/exchange.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const mocap::testing::FuzzFile file(data, size);
  using Reader = std::vector<mocap::ForeignCamera> (*)(const std::filesystem::path&);
  constexpr std::array<Reader, 7> kReaders = {
      [](const auto& path) { return mocap::ReadPose2Sim(path, 1000); },
      [](const auto& path) { return mocap::ReadEasyMocap(path, path); },
      [](const auto& path) { return mocap::ReadOpenCv(path); },
      [](const auto& path) { return mocap::ReadKalibr(path); },
      [](const auto& path) { return mocap::ReadWillson(path); },
      [](const auto& path) { return mocap::ReadQualisys(path); },
      [](const auto& path) { return mocap::ReadVicon(path); }};
  for (const Reader read : kReaders) {
    try {
      mocap::CheckForeignCameras("fuzz", read(file.path()),
                                 {.size_px = {{640, 480}}, .lenses_alone = size % 2 == 0});
    } catch (const mocap::SetupError&) {
      // The one way to say that a file is wrong.
    }
  }
  return 0;
}
