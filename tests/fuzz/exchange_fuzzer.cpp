// Every reader of other programs' calibrations, on the same bytes.
#include <cstdint>

#include "core/errors.h"
#include "tools/calibration/foreign_program.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const mocap::ForeignProgram& program : mocap::ForeignPrograms()) {
    try {
      // Programs with a folder of their own have at most two files in it.
      mocap::CheckForeignCameras("fuzz", program.read({{"fuzz", text}, {"fuzz", text}}, program),
                                 {.size_px = {{640, 480}}, .lenses_alone = size % 2 == 0});
    } catch (const mocap::SetupError&) {
      // The one way to say that a file is wrong.
    }
  }
  return 0;
}
