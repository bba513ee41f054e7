// The daemon as a program: its messages in another process, its exit status, its errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <mocap/body_t.hpp>
#include <mocap/pose_t.hpp>
#include <mocap/status_t.hpp>
#include <string>
#include <thread>
#include <vector>

#include "config/open_studio.h"
#include "daemon/control/control_socket.h"
#include "tests/daemon/daemon_program.h"
#include "tests/daemon/mocapd_fixture.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using testing::Daemon;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using testing::MocapdTest;
using testing::SmallTake;
using ::testing::StartsWith;
using testing::WriteEmptyTake;

/// Collects what the daemon says.
class Listener {
 public:
  explicit Listener(lcm::LCM& lcm) {
    lcm.subscribe("T_MOCAP_POSE", &Listener::OnPose, this)->setQueueCapacity(1000);
    lcm.subscribe("T_MOCAP_BODY", &Listener::OnBody, this);
    lcm.subscribe("T_MOCAP_STATUS", &Listener::OnStatus, this);
  }
  std::vector<pose_t> poses;
  std::vector<body_t> bodies;
  std::vector<status_t> statuses;

 private:
  void OnPose(const lcm::ReceiveBuffer*, const std::string&, const pose_t* message) {
    poses.push_back(*message);
  }
  void OnBody(const lcm::ReceiveBuffer*, const std::string&, const body_t* message) {
    bodies.push_back(*message);
  }
  void OnStatus(const lcm::ReceiveBuffer*, const std::string&, const status_t* message) {
    statuses.push_back(*message);
  }
};

TEST_F(MocapdTest, PublishesEverySetOfATakeInRealTimeInOrder) {
  std::string reason;
  const std::unique_ptr<lcm::LCM> lcm = Open(reason);
  if (!lcm) GTEST_SKIP() << reason;
  const SmallTake take{.frames = 20, .interval_ns = 150'000'000};
  WriteEmptyTake(folder_.path() / "take", take);
  Listener listener(*lcm);
  Daemon daemon(
      {"--config", WriteConfig("driver = \"take\"\ntake = \"take\"\nrate = \"realtime\"\n")}, log_);
  while (!daemon.HasEnded()) lcm->handleTimeout(50);
  while (lcm->handleTimeout(50) > 0) {
  }
  EXPECT_EQ(daemon.Wait(), 0) << daemon.Errors();
  ASSERT_GE(listener.poses.size(), 0.99 * take.frames);
  for (std::size_t i = 0; i < listener.poses.size(); ++i) {
    EXPECT_EQ(listener.poses[i].frame, static_cast<std::int64_t>(i));
    EXPECT_GE(listener.poses[i].complete_utime, listener.poses[i].utime);
    EXPECT_GE(listener.poses[i].publish_utime, listener.poses[i].complete_utime);
    EXPECT_THAT(listener.poses[i].camera_used, ::testing::Each(1));
  }
  EXPECT_GE(listener.bodies.size(), 3u) << "one a second";
  ASSERT_GE(listener.statuses.size(), 3u);
  const status_t& last = listener.statuses.back();
  EXPECT_EQ(last.sets_dropped, 0);
  ASSERT_EQ(last.cameras.size(), 3u);
  EXPECT_EQ(last.cameras[0].name, "cam1");
}

TEST_F(MocapdTest, ASignalEndsItCleanly) {
  std::string reason;
  const std::unique_ptr<lcm::LCM> lcm = Open(reason);
  if (!lcm) GTEST_SKIP() << reason;
  WriteEmptyTake(folder_.path() / "take");
  for (const int signal : {SIGINT, SIGTERM}) {
    Listener listener(*lcm);
    Daemon daemon({"--config", WriteConfig("driver = \"take\"\ntake = \"take\"\nloop = true\n")},
                  log_);
    while (listener.poses.empty() && !daemon.HasEnded()) lcm->handleTimeout(50);
    daemon.Signal(signal);
    EXPECT_EQ(daemon.Wait(), 0) << daemon.Errors();
    EXPECT_THAT(daemon.Errors(), HasSubstr(" sets, "));
    while (lcm->handleTimeout(10) > 0) {
    }
  }
}

/// Frames that the daemon says it has written; -1 while it does not answer.
std::int64_t FramesWritten(const std::filesystem::path& socket) {
  try {
    const std::string status = AskDaemon(socket, "status json").text;
    const std::size_t recording = status.find("\"recording\"");
    const std::size_t frames = status.find("\"frames\":", recording);
    return recording == std::string::npos ? -1 : std::stoll(status.substr(frames + 9));
  } catch (const std::runtime_error&) {
    return -1;
  }
}

TEST_F(MocapdTest, WhatItSaysIsWrittenSurvivesAKill) {
  std::string reason;
  if (!Open(reason)) GTEST_SKIP() << reason;
  WriteEmptyTake(folder_.path() / "take", {.frames = 50});
  const std::filesystem::path socket = folder_.path() / "control";
  const std::string config =
      WriteConfig("driver = \"take\"\ntake = \"take\"\nloop = true\n",
                  "[control]\nsocket = \"control\"\n[recording]\nfolder = \"takes\"\n");
  for (const std::int64_t enough : {20, 50, 100}) {
    Daemon daemon({"--config", config}, log_);
    while (FramesWritten(socket) < 0 && !daemon.HasEnded()) std::this_thread::yield();
    ASSERT_EQ(AskDaemon(socket, "record start killed").outcome, ControlOutcome::kDone);
    std::int64_t said = 0;
    while (said < enough && !daemon.HasEnded()) said = FramesWritten(socket);
    daemon.Signal(SIGKILL);
    ASSERT_EQ(daemon.Wait(), -SIGKILL) << daemon.Errors();
    const std::filesystem::path take = folder_.path() / "takes" / "killed.partial";
    std::int64_t there = 0;
    for (StudioCamera& camera : OpenTake(take, {}).cameras) {
      camera.driver->Start();
      Frame frame;
      while (camera.driver->Grab(frame, std::chrono::seconds(1)) == GrabStatus::kFrame) ++there;
      camera.driver->Stop();
    }
    EXPECT_GE(there, said);
    std::filesystem::remove_all(take);
  }
}

TEST_F(MocapdTest, ATakeThatNodesDoNotRecordIsCanceledAndWhoCannotCancelItIsNamed) {
  std::string reason;
  if (!Open(reason)) GTEST_SKIP() << reason;
  WriteEmptyTake(folder_.path() / "take");
  const std::string config =
      WriteConfig("driver = \"none\"\n",
                  "[control]\nsocket = \"control\"\n[recording]\nfolder = \"takes\"\n"
                  "[[nodes]]\nname = \"left\"\ncameras = [\"cam1\", \"cam2\"]\n"
                  "control = [\"/bin/sh\", \"-c\", \"read -r words; case $words in *' a') "
                  "printf 'failed\\nfull\\n';; *) false; esac\"]\n",
                  "role = \"studio\"\ncalibration = \"take/calibration.toml\"\n");
  const std::filesystem::path socket = folder_.path() / "control";
  Daemon daemon({"--config", config}, log_);
  while (FramesWritten(socket) < 0 && !daemon.HasEnded()) std::this_thread::yield();
  EXPECT_EQ(AskDaemon(socket, "record start a").text, "node left: full; nothing is recorded");
  const ControlReply reply = AskDaemon(socket, "record start walk");
  EXPECT_EQ(reply.outcome, ControlOutcome::kFailed);
  EXPECT_THAT(reply.text, HasSubstr("may be left, as not all could cancel it; node left: "));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path() / "takes"));
  daemon.Signal(SIGTERM);
  EXPECT_EQ(daemon.Wait(), 0) << daemon.Errors();
  EXPECT_THAT(daemon.Errors(), HasSubstr("the recording a was canceled: node left: full"));
}

TEST_F(MocapdTest, ATakeIsCompletedEverywhereWhenTheStudioStopsAndItsLogSaysSo) {
  std::string reason;
  if (!Open(reason)) GTEST_SKIP() << reason;
  WriteEmptyTake(folder_.path() / "take");
  const std::string asked = folder_.path() / "asked";
  const std::string config =
      WriteConfig("driver = \"none\"\n",
                  "[control]\nsocket = \"control\"\n[recording]\nfolder = \"takes\"\n"
                  "[[nodes]]\nname = \"left\"\ncameras = [\"cam1\", \"cam2\"]\n"
                  "control = [\"/bin/sh\", \"-c\", \"read -r words; echo \\\"$words\\\" >> " +
                      asked + "; printf 'done\\\\n%s\\\\n' \\\"$words\\\"\"]\n",
                  "role = \"studio\"\ncalibration = \"take/calibration.toml\"\n");
  const std::filesystem::path socket = folder_.path() / "control";
  Daemon daemon({"--config", config}, log_);
  while (FramesWritten(socket) < 0 && !daemon.HasEnded()) std::this_thread::yield();
  ASSERT_EQ(AskDaemon(socket, "record start walk").outcome, ControlOutcome::kDone);
  daemon.Signal(SIGINT);
  EXPECT_EQ(daemon.Wait(), 0);
  EXPECT_EQ(testing::ReadText(asked), "record start walk\nrecord stop\n");
  EXPECT_THAT(daemon.Errors(),
              AllOf(HasSubstr("stopping on a signal"), HasSubstr("recorded "),
                    HasSubstr("takes/walk: "), HasSubstr("node left: record stop")));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "takes" / "walk" / "take.toml"));
}

TEST_F(MocapdTest, WrongInputIsOneLineAndStatusTwo) {
  const std::string config = WriteConfig("driver = \"take\"\ntake = \"absent\"\n");
  const std::string broken = folder_.path() / "broken.toml";
  testing::WriteText(broken, "[source\n");
  const std::vector<std::vector<std::string>> wrong = {
      {"--config", folder_.path() / "nothing.toml"},
      {"--config", broken},
      {"--config", config, "--check-config"},
      {"--seconds", "soon"},
      {"--seconds", "-1"},
      {"--frobnicate"}};
  for (const std::vector<std::string>& arguments : wrong) {
    Daemon daemon(arguments, log_);
    EXPECT_EQ(daemon.Wait(), 2) << arguments[0];
    const std::string errors = daemon.Errors();
    EXPECT_THAT(errors, StartsWith("mocapd: "));
    EXPECT_THAT(errors, EndsWith("\n"));
    EXPECT_EQ(std::ranges::count(errors, '\n'), 1) << errors;
  }
}

TEST_F(MocapdTest, ASignalEndsItWhileTheEmptyStudioIsLearned) {
  std::string reason;
  if (!Open(reason)) GTEST_SKIP() << reason;
  // Painting these takes minutes.
  const std::string config =
      WriteConfig("driver = \"simulated\"\ncameras = 12\nwidth = 1920\nheight = 1080\n");
  Daemon daemon({"--config", config}, log_);
  while (!daemon.HasEnded() && daemon.Errors().find("learning") == std::string::npos) {
    std::this_thread::yield();
  }
  daemon.Signal(SIGTERM);
  EXPECT_EQ(daemon.Wait(), 0) << daemon.Errors();
  EXPECT_THAT(daemon.Errors(), HasSubstr("stopped while starting"));
}

TEST_F(MocapdTest, SaysThatItIsStartingWhileItLearns) {
  std::string reason;
  if (!Open(reason)) GTEST_SKIP() << reason;
  const std::string config =
      WriteConfig("driver = \"simulated\"\ncameras = 12\nwidth = 1920\nheight = 1080\n",
                  "[control]\nsocket = \"control\"\n");
  Daemon daemon({"--config", config}, log_);
  ControlReply reply;
  while (reply.text.empty() && !daemon.HasEnded()) {
    try {
      reply = AskDaemon(folder_.path() / "control", "status");
    } catch (const std::runtime_error&) {
      std::this_thread::yield();  // It is not there yet.
    }
  }
  EXPECT_EQ(reply.outcome, ControlOutcome::kFailed);
  EXPECT_THAT(reply.text, HasSubstr("mocapd is starting"));
}

TEST_F(MocapdTest, CanBeAskedBeforeItOpensItsCameras) {
  // Two daemons cannot both be asked there, so the second is refused where the socket is made.
  const ControlServer other(folder_.path() / "control",
                            [](const ControlRequest&) { return ControlReply{}; });
  const std::string config =
      WriteConfig("driver = \"take\"\ntake = \"nowhere\"\n", "[control]\nsocket = \"control\"\n");
  Daemon daemon({"--config", config}, log_);
  EXPECT_EQ(daemon.Wait(), 2);
  EXPECT_THAT(daemon.Errors(), HasSubstr("another mocapd uses this socket"));
}

TEST_F(MocapdTest, ATakeThatIsNotThereIsToldWithFileAndKey) {
  const std::string config = WriteConfig("driver = \"take\"\ntake = \"wlak\"\n");
  Daemon check({"--config", config, "--check-config"}, log_);
  EXPECT_EQ(check.Wait(), 2);
  EXPECT_EQ(check.Errors(), "mocapd: " + config + ": source.take is " +
                                (folder_.path() / "wlak").string() +
                                ", which is not there; expected the folder of a take\n");
}

TEST_F(MocapdTest, AReaderOfItsLogThatGoesAwayDoesNotEndIt) {
  std::string reason;
  if (!Open(reason)) GTEST_SKIP() << reason;
  WriteEmptyTake(folder_.path() / "take");
  const std::string config = WriteConfig("driver = \"take\"\ntake = \"take\"\n");
  // `true` reads nothing. The shell's status is the daemon's.
  const std::string command = "bash -c '" + std::string(MOCAP_BIN_DIR) + "/mocapd --config " +
                              config + " 2>&1 | true; exit ${PIPESTATUS[0]}'";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST_F(MocapdTest, RunsWithoutStandardFiles) {
  std::string reason;
  if (!Open(reason)) GTEST_SKIP() << reason;
  WriteEmptyTake(folder_.path() / "take");
  const std::string config = WriteConfig("driver = \"take\"\ntake = \"take\"\n");
  const std::string command = std::string(MOCAP_BIN_DIR) + "/mocapd --config " + config;
  const int status = std::system((command + " <&- >&- 2>&-").c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace mocap
