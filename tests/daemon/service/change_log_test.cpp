#include "daemon/service/change_log.h"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <initializer_list>
#include <memory>
#include <sstream>
#include <string>

namespace mocap {
namespace {

/// Collects what is logged.
class ChangeLogTest : public ::testing::Test {
 protected:
  ChangeLogTest() {
    auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(told_);
    sink->set_pattern("%v");
    spdlog::set_default_logger(std::make_shared<spdlog::logger>("test", std::move(sink)));
    status_.tracks = false;
    for (const char* name : {"cam1", "cam2", "cam3"}) status_.cameras.emplace_back().name = name;
    log_.Add(status_);
  }
  ~ChangeLogTest() override { spdlog::set_default_logger(usual_); }

  /// What is logged when the cameras reach these states.
  std::string At(std::initializer_list<CameraState> states) {
    told_.str("");
    std::size_t camera = 0;
    for (const CameraState state : states) status_.cameras[camera++].state = state;
    log_.Add(status_);
    return told_.str();
  }

  const std::shared_ptr<spdlog::logger> usual_ = spdlog::default_logger();
  std::ostringstream told_;
  ChangeLog log_;
  PipelineStatus status_;
};

TEST_F(ChangeLogTest, TellsARemarkThatCountsOnce) {
  for (const char* remark : {"3 packets are missing", "125 packets are missing"}) {
    for (CameraStatus& camera : status_.cameras) camera.remarks = {remark};
    log_.Add(status_);
  }
  EXPECT_EQ(told_.str(),
            "cam1: 3 packets are missing\ncam2: 3 packets are missing\ncam3: 3 packets are "
            "missing\n");
}

TEST_F(ChangeLogTest, TellsInOneLineWhatSeveralCamerasDo) {
  constexpr CameraState kLost = CameraState::kLost, kStreams = CameraState::kStreaming,
                        kEnded = CameraState::kEnded;
  EXPECT_EQ(At({kStreams, kStreams, kStreams}), "all 3 cameras deliver frames\n");
  EXPECT_EQ(At({kLost, kLost, kStreams}), "cam1, cam2 are lost\n");
  EXPECT_EQ(At({kStreams, kStreams, kLost}), "cam3 is lost\ncam1, cam2 are back\n");
  EXPECT_EQ(At({kEnded, kEnded, kEnded}), "all 3 cameras have ended\n");
}

}  // namespace
}  // namespace mocap
