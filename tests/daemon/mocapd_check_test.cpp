// mocapd --check-config: what it refuses and accepts, beside what a start does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/daemon/daemon_program.h"
#include "tests/daemon/mocapd_fixture.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using testing::Daemon;
using ::testing::HasSubstr;
using testing::MocapdTest;
using testing::WriteEmptyTake;

TEST_F(MocapdTest, WhatTheStartRefusesTheCheckRefusesWithTheSameWords) {
  WriteEmptyTake(folder_.path() / "take");
  testing::WriteText(folder_.path() / "file", "x");
  const std::string take = "driver = \"take\"\ntake = \"take\"\n";
  const std::pair<std::string, std::string> wrong[] = {
      {"driver = \"simulated\"\ncameras = 65\nwidth = 32\nheight = 32\n", ""},
      {take, "[realtime]\nprocessors = [1023]\n"},
      {take, "[metrics]\nfile = \"m.txt\"\n"},
      {take, "[metrics]\nfile = \"nowhere/m.prom\"\n"},
      {take, "[recording]\nfolder = \"file/takes\"\n"},
      {take, "[control]\nsocket = \"file\"\n"},
      {take, "[control]\nsocket = \"file/control\"\n"},
      {take, "[control]\nsocket = \"" + std::string(200, 'x') + "\"\n"}};
  for (const auto& [source, more] : wrong) {
    const std::string config = WriteConfig(source, more);
    Daemon start({"--config", config}, log_);
    EXPECT_EQ(start.Wait(), 2) << source << more;
    const std::string said = start.Errors();
    Daemon check({"--config", config, "--check-config"}, log_);
    EXPECT_EQ(check.Wait(), 2) << source << more;
    EXPECT_THAT(said, HasSubstr(check.Errors())) << source << more;
  }
  for (const char* url : {"udpm://192.168.1.5:7667", "udpm://239.255.76.67:7667?ttl=300",
                          "tcpq://127.0.0.1:9", "file:///nowhere/x?mode=w", "file:///tmp/x"}) {
    const std::string config = folder_.path() / "url.toml";
    testing::WriteText(config, "[source]\n" + take + "[lcm]\nurl = \"" + url + "\"\n");
    EXPECT_EQ(Daemon({"--config", config}, log_).Wait(), 2) << url;
    EXPECT_EQ(Daemon({"--config", config, "--check-config"}, log_).Wait(), 2) << url;
  }
}

TEST_F(MocapdTest, AMisspeltProgramThatAsksANodeIsRefused) {
  const std::string config = folder_.path() / "studio.toml";
  const std::string missing = folder_.path() / "ssh";
  for (const std::string& program : {std::string("shh"), missing, folder_.path().string()}) {
    testing::WriteText(config,
                       "role = \"studio\"\ncalibration = \"c.toml\"\n[source]\ndriver = \"none\"\n"
                       "fps = 60\n[lcm]\nurl = \"memq://\"\n[[nodes]]\nname = \"left\"\n"
                       "cameras = [\"cam1\"]\ncontrol = [\"" +
                           program + "\", \"left\"]\n");
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--check-config"}}) {
      std::vector<std::string> arguments = {"--config", config};
      arguments.insert(arguments.end(), more.begin(), more.end());
      Daemon daemon(arguments, log_);
      EXPECT_EQ(daemon.Wait(), 2);
      EXPECT_THAT(daemon.Errors(), AllOf(HasSubstr("control of the node \"left\""),
                                         HasSubstr("which is no program here")));
    }
  }
}

TEST_F(MocapdTest, CheckConfigLeavesNothing) {
  WriteEmptyTake(folder_.path() / "take");
  const std::string config = folder_.path() / "mocapd.toml";
  testing::WriteText(config,
                     "[source]\ndriver = \"take\"\ntake = \"take\"\n[lcm]\nurl = \"file://" +
                         (folder_.path() / "log.lcm").string() +
                         "?mode=w\"\n[recording]\nfolder = \"takes\"\n[metrics]\nfile = "
                         "\"m.prom\"\n[control]\nsocket = \"run/control\"\n");
  Daemon check({"--config", config, "--check-config"}, log_);
  EXPECT_EQ(check.Wait(), 0) << check.Errors();
  std::vector<std::string> there;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    there.push_back(entry.path().filename());
  }
  EXPECT_THAT(there, ::testing::UnorderedElementsAre("take", "mocapd.toml", "errors"));
}

TEST_F(MocapdTest, CheckConfigAcceptsWhatCanBeUsedAndSaysWhatIsDoubtful) {
  WriteEmptyTake(folder_.path() / "take");
  const std::string config = WriteConfig("driver = \"take\"\ntake = \"take\"\n");
  Daemon check({"--config", config, "--check-config"}, log_);
  EXPECT_EQ(check.Wait(), 0);
  EXPECT_THAT(check.Errors(), HasSubstr("mocapd: warning: "));
  EXPECT_THAT(check.Errors(), HasSubstr("calibration.toml: all cameras hang below the floor"));
  EXPECT_EQ(Daemon({"--check-config"}, log_).Wait(), 0) << "the simulated studio";
}

}  // namespace
}  // namespace mocap
