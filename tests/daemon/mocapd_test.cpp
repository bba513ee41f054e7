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
#include "core/errors.h"
#include "daemon/control/control_socket.h"
#include "daemon/messages/pose_publisher.h"
#include "tests/daemon/daemon_program.h"
#include "tests/support/small_take.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using testing::Daemon;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using testing::SmallTake;
using ::testing::StartsWith;
using testing::TemporaryFolder;

/// Nobody comes: there is next to nothing to compute, so that even a slow machine keeps up.
void WriteEmptyTake(const std::filesystem::path& folder, const SmallTake& take = {}) {
  constexpr int kBackgroundFrames = 10;
  const Image<Bgr> room = testing::SmallPicture(take, 0, 0);
  TakeWriter writer(folder, testing::SmallDescription(take));
  for (int camera = 0; camera < take.cameras; ++camera) {
    for (int frame = 0; frame < kBackgroundFrames; ++frame) {
      writer.WriteBackground(camera, room.view(), take.TimeNs(camera, frame), {});
    }
    for (int frame = 0; frame < take.frames; ++frame) {
      writer.WriteFrame(camera, room.view(), take.TimeNs(camera, frame), {});
    }
  }
  writer.Finish();
}

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

class MocapdTest : public ::testing::Test {
 protected:
  /// A port of this process's own, so that tests at the same time do not hear each other.
  const std::string url_ =
      "udpm://239.255.76.67:" + std::to_string(20000 + getpid() % 40000) + "?ttl=0";
  TemporaryFolder folder_;
  const std::filesystem::path log_ = folder_.path() / "errors";

  std::string WriteConfig(const std::string& source, const std::string& more = "",
                          const std::string& top = "") {
    const std::filesystem::path file = folder_.path() / "mocapd.toml";
    testing::WriteText(file, top + "[source]\n" + source + "[lcm]\nurl = \"" + url_ +
                                 "\"\nprefix = \"T_\"\n" + more);
    return file;
  }
  /// Null, with the reason, where LCM has no way out.
  std::unique_ptr<lcm::LCM> Open(std::string& reason) {
    try {
      return OpenLcm(url_);
    } catch (const SetupError& error) {
      reason = error.what();
      return nullptr;
    }
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
    const std::size_t frames = status.find("\"frames\": ", recording);
    return recording == std::string::npos ? -1 : std::stoll(status.substr(frames + 10));
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
