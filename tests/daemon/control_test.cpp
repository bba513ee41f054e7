// Requests from the line of words to the answer over the socket.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cstdlib>
#include <cstring>
#include <string>

#include "config/config.h"
#include "core/errors.h"
#include "daemon/control/control_request.h"
#include "daemon/control/control_socket.h"
#include "daemon/service/service_setup.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TemporaryFolder;

TEST(ControlRequest, UnderstandsWhatMocapSends) {
  EXPECT_TRUE(std::holds_alternative<StatusRequest>(*ParseControlRequest("status")));
  EXPECT_TRUE(std::get<StatusRequest>(*ParseControlRequest("status json\n")).as_json);
  EXPECT_TRUE(std::holds_alternative<ReloadRequest>(*ParseControlRequest("reload")));
  EXPECT_TRUE(std::holds_alternative<LookRequest>(*ParseControlRequest("look")));
  EXPECT_EQ(std::get<RecordStartRequest>(*ParseControlRequest("record start a.b_c-1")).name,
            "a.b_c-1");
  EXPECT_TRUE(std::holds_alternative<RecordStopRequest>(*ParseControlRequest("record stop")));
  EXPECT_EQ(std::get<RecordCancelRequest>(*ParseControlRequest("record cancel walk")).name, "walk");
  EXPECT_EQ(std::get<SubjectSaveRequest>(*ParseControlRequest("subject save eve")).name, "eve");
  EXPECT_FALSE(std::get<SubjectSaveRequest>(*ParseControlRequest("subject save eve")).person);
  EXPECT_EQ(std::get<SubjectSaveRequest>(*ParseControlRequest("subject save eve 12")).person, 12);
  EXPECT_EQ(std::get<SubjectLoadRequest>(*ParseControlRequest("subject load eve")).name, "eve");
  EXPECT_FALSE(std::get<BackgroundLearnRequest>(*ParseControlRequest("background learn")).anyway);
  EXPECT_TRUE(
      std::get<BackgroundLearnRequest>(*ParseControlRequest("background learn anyway")).anyway);
  const auto occupied =
      std::get<BackgroundOccupiedRequest>(*ParseControlRequest("background occupied 60"));
  EXPECT_EQ(occupied.seconds, 60);
  EXPECT_THAT(occupied.accepted, IsEmpty());
  EXPECT_THAT(
      std::get<BackgroundOccupiedRequest>(*ParseControlRequest("background occupied 7.5 cam1,cam3"))
          .accepted,
      ElementsAre("cam1", "cam3"));
  EXPECT_TRUE(
      std::holds_alternative<BackgroundResultRequest>(*ParseControlRequest("background result")));
  EXPECT_TRUE(
      std::holds_alternative<BackgroundStatusRequest>(*ParseControlRequest("background status")));
}

TEST(ControlRequest, RefusesEverythingElse) {
  for (const char* line : {"",
                           " ",
                           "status  json",
                           "record",
                           "record start",
                           "record start a b",
                           "record cancel",
                           "subject save",
                           "subject save eve 0",
                           "subject save eve -1",
                           "subject save eve 1x",
                           "subject save ../eve 1",
                           "subject load eve 1",
                           "STATUS",
                           "background occupied",
                           "background occupied x",
                           "background occupied 0.5",
                           "background occupied 601",
                           "background occupied nan",
                           "background occupied 60 a/b",
                           "background occupied 60 cam1 cam2",
                           "status\nreload"}) {
    EXPECT_FALSE(ParseControlRequest(line)) << line;
  }
  EXPECT_FALSE(ParseControlRequest(std::string(kLongestRequest + 1, 'a')));
}

TEST(ControlRequest, NamesCannotLeaveTheirFolder) {
  for (const char* name : {"..", "../x", "/etc/passwd", ".hidden", "-rf", "a/b", "a b", ""}) {
    EXPECT_FALSE(IsFileName(name)) << name;
    EXPECT_FALSE(ParseControlRequest(std::string("record start ") + name)) << name;
  }
  EXPECT_FALSE(IsFileName(std::string(65, 'a')));
  EXPECT_FALSE(IsFileName(std::string("a\0b", 3)));
}

TEST(ControlRequest, NoTakeGoesByTheNameOfAnUnfinishedOne) {
  EXPECT_FALSE(ParseControlRequest("record start walk.partial"));
  EXPECT_TRUE(ParseControlRequest("record start partial"));
  EXPECT_FALSE(IsFileName("walk.partial"));
}

TEST(ControlReply, ComesBackAsItWasSent) {
  for (const ControlOutcome outcome :
       {ControlOutcome::kDone, ControlOutcome::kFailed, ControlOutcome::kWrong}) {
    const auto reply = DecodeReply(EncodeReply({outcome, "two\nlines"}));
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->outcome, outcome);
    EXPECT_EQ(reply->text, "two\nlines");
  }
  EXPECT_FALSE(DecodeReply("perhaps\n"));
  EXPECT_FALSE(DecodeReply("done"));
}

class ControlSocketTest : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  const std::filesystem::path socket_ = folder_.path() / "run" / "control";
};

TEST_F(ControlSocketTest, TheHandlersAnswerArrives) {
  ControlServer server(socket_, [](const ControlRequest& request) -> ControlReply {
    return {ControlOutcome::kDone, std::get<SubjectSaveRequest>(request).name};
  });
  const ControlReply reply = AskDaemon(socket_, "subject save eve");
  EXPECT_EQ(reply.outcome, ControlOutcome::kDone);
  EXPECT_EQ(reply.text, "eve");
}

TEST_F(ControlSocketTest, WhatTheHandlerThrowsBecomesTheAnswer) {
  ControlServer server(socket_, [](const ControlRequest& request) -> ControlReply {
    if (std::holds_alternative<ReloadRequest>(request)) throw SetupError("wrong file");
    throw std::runtime_error("no room");
  });
  EXPECT_EQ(AskDaemon(socket_, "reload").outcome, ControlOutcome::kWrong);
  EXPECT_EQ(AskDaemon(socket_, "status").outcome, ControlOutcome::kFailed);
  EXPECT_EQ(AskDaemon(socket_, "dance").outcome, ControlOutcome::kWrong);
}

TEST_F(ControlSocketTest, AHangUpInTheMiddleDoesNotStopIt) {
  ControlServer server(socket_, [](const ControlRequest&) {
    return ControlReply{ControlOutcome::kDone, ""};
  });
  for (int i = 0; i < 3; ++i) {
    const FileDescriptor caller(socket(AF_UNIX, SOCK_SEQPACKET, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, socket_.c_str());
    ASSERT_EQ(connect(caller.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  EXPECT_EQ(AskDaemon(socket_, "status").outcome, ControlOutcome::kDone);
}

TEST_F(ControlSocketTest, OnlyOwnerAndGroupMayAsk) {
  ControlServer server(socket_, [](const ControlRequest&) { return ControlReply{}; });
  struct stat status {};
  ASSERT_EQ(stat(socket_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0660u);
}

TEST_F(ControlSocketTest, ASecondDaemonIsRefusedAndADeadOnesSocketIsTakenOver) {
  const auto handler = [](const ControlRequest&) { return ControlReply{}; };
  {
    ControlServer server(socket_, handler);
    EXPECT_THROW(ControlServer(socket_, handler), SetupError);
  }
  EXPECT_FALSE(std::filesystem::exists(socket_));
  {
    const FileDescriptor dead(socket(AF_UNIX, SOCK_SEQPACKET, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, socket_.c_str());
    ASSERT_EQ(bind(dead.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  ControlServer server(socket_, handler);
  EXPECT_EQ(AskDaemon(socket_, "status").outcome, ControlOutcome::kDone);
}

TEST_F(ControlSocketTest, WithoutADaemonTheMessageSaysWhatToDo) {
  try {
    AskDaemon(socket_, "status");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("nothing answers at " + socket_.string()));
  }
}

TEST_F(ControlSocketTest, WithoutANamedSocketTheMessageNamesWhereItAsked) {
  const auto told = [] {
    try {
      AskDaemon("", "status");
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  setenv("XDG_RUNTIME_DIR", "/nowhere", 1);
  EXPECT_THAT(told(), ::testing::StartsWith(
                          "nothing answers at /run/mocapd/control or /nowhere/mocapd/control: "));
  unsetenv("XDG_RUNTIME_DIR");
  EXPECT_THAT(told(), HasSubstr("XDG_RUNTIME_DIR is not set, so a mocapd of your own needs"));
}

TEST(ControlSocket, ADaemonThatHasNoneSaysSo) {
  unsetenv("RUNTIME_DIRECTORY");
  unsetenv("XDG_RUNTIME_DIR");
  Config config;
  config.lcm.url = "memq://";
  EXPECT_THAT(CheckConfig(config), ElementsAre(HasSubstr("there is no control socket")));
  setenv("XDG_RUNTIME_DIR", "/tmp", 1);
  EXPECT_THAT(CheckConfig(config), IsEmpty());
  unsetenv("XDG_RUNTIME_DIR");
}

}  // namespace
}  // namespace mocap
