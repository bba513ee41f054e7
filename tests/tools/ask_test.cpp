// `mocap ask`, as sshd runs it for the computer that asks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/errors.h"
#include "daemon/base/other_program.h"
#include "daemon/control/control_socket.h"
#include "daemon/control/remote_control.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

constexpr std::chrono::milliseconds kLong{60'000};

class Ask : public ::testing::Test {
 protected:
  std::vector<std::string> Command() const {
    return {MOCAP_BIN_DIR "/mocap", "ask", "--socket", socket_.string()};
  }
  RemoteAnswer Asked(const std::string& request) const {
    return RemoteControl("left", Command()).Ask(request, kLong);
  }
  ControlServer Serve() {
    return {socket_, [this](const ControlRequest& request) -> ControlReply {
              ++requests_;
              if (std::holds_alternative<ReloadRequest>(request)) throw SetupError("wrong file");
              return {ControlOutcome::kDone, "two\nlines"};
            }};
  }

  testing::TemporaryFolder folder_;
  const std::filesystem::path socket_ = folder_.path() / "control";
  int requests_ = 0;
};

TEST_F(Ask, TheDaemonsReplyComesAsItIs) {
  const ControlServer server = Serve();
  const RemoteAnswer answer = Asked("status");
  ASSERT_TRUE(answer.reply) << answer.problem;
  EXPECT_EQ(answer.reply->outcome, ControlOutcome::kDone);
  EXPECT_EQ(answer.reply->text, "two\nlines");
  const RemoteAnswer refused = Asked("reload");
  ASSERT_TRUE(refused.reply) << refused.problem;
  EXPECT_EQ(refused.reply->outcome, ControlOutcome::kWrong);
  EXPECT_EQ(refused.reply->text, "wrong file");
}

TEST_F(Ask, WhatIsNoRequestDoesNothingAndIsTold) {
  const ControlServer server = Serve();
  for (const std::string& request :
       {std::string("dance"), std::string("status\nreload"), std::string("record start ../x"),
        std::string(100, '\0'), std::string(kLongestRequest, '\xff'), std::string()}) {
    const RemoteAnswer answer = Asked(request);
    ASSERT_TRUE(answer.reply) << answer.problem;
    EXPECT_EQ(answer.reply->outcome, ControlOutcome::kWrong);
    EXPECT_NE(answer.reply->text, "");
  }
  EXPECT_EQ(requests_, 0);
}

TEST_F(Ask, ARequestThatIsTooLongIsNotReadToItsEnd) {
  const ControlServer server = Serve();
  const ProgramRun run = RunOtherProgram(Command(), std::string(4000, 'a'),
                                         {.patience = kLong, .longest_output = kLongestReply});
  EXPECT_THAT(run.output, HasSubstr("wrong\nthe request does not end within 512 bytes"));
  EXPECT_EQ(requests_, 0);
}

TEST_F(Ask, WithoutADaemonTheReplySaysSo) {
  const RemoteAnswer answer = Asked("status");
  ASSERT_TRUE(answer.reply) << answer.problem;
  EXPECT_EQ(answer.reply->outcome, ControlOutcome::kFailed);
  EXPECT_THAT(answer.reply->text, HasSubstr("nothing answers at " + socket_.string()));
}

}  // namespace
}  // namespace mocap
