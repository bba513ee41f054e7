#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "daemon/control/control_request.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto request = mocap::ParseControlRequest(text)) {
    // Whatever gets through as a name stays in its folder.
    if (const auto* start = std::get_if<mocap::RecordStartRequest>(&*request)) {
      if (start->name.find('/') != std::string::npos || start->name[0] == '.') std::abort();
    }
  }
  mocap::DecodeReply(text);
  return 0;
}
