#include "daemon/service/change_log.h"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <sstream>

namespace mocap {
namespace {

TEST(ChangeLog, TellsARemarkThatCountsOnce) {
  std::ostringstream told;
  const auto usual = spdlog::default_logger();
  auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(told);
  sink->set_pattern("%v");
  spdlog::set_default_logger(std::make_shared<spdlog::logger>("test", std::move(sink)));
  ChangeLog log;
  PipelineStatus status;
  for (const char* name : {"cam1", "cam2"}) status.cameras.emplace_back().name = name;
  for (const char* remark : {"3 packets are missing", "125 packets are missing"}) {
    for (CameraStatus& camera : status.cameras) camera.remarks = {remark};
    log.Add(status);
  }
  spdlog::set_default_logger(usual);
  EXPECT_EQ(told.str(), "searching\ncam1: 3 packets are missing\ncam2: 3 packets are missing\n");
}

}  // namespace
}  // namespace mocap
