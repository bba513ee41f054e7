#include "daemon/service/printable_log.h"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <sstream>

namespace mocap {
namespace {

TEST(PrintableLog, AMessageStaysALineWithoutControlCharacters) {
  std::ostringstream out;
  const auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(out);
  sink->set_formatter(PrintableLogFormat("%n: %l: %*"));
  spdlog::logger log("mocapd", sink);
  log.info("learning {}, 3 cameras", "x\x1b]0;owned\x07\nmocapd: error: forged");
  log.warn("Jürgen");
  EXPECT_EQ(out.str(),
            "mocapd: info: learning x\\x1b]0;owned\\x07\\x0amocapd: error: forged, 3 cameras\n"
            "mocapd: warning: Jürgen\n");
}

}  // namespace
}  // namespace mocap
