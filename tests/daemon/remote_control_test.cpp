// A node's daemon asked by a command, which here is a few lines of shell that answer, or do not.
#include "daemon/control/remote_control.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>

#include "daemon/base/file_descriptor.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using std::chrono::milliseconds;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// More than any answer takes, so that no machine is too slow for the tests.
constexpr milliseconds kLong{60'000};
constexpr milliseconds kShort{50};

RemoteAnswer AskShell(const std::string& script, milliseconds patience = kLong,
                      const std::string& request = "status") {
  return RemoteControl("left", {"/bin/sh", "-c", script}).Ask(request, patience);
}

bool HasChildren() { return waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD; }

std::size_t OpenFiles() {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator("/proc/self/fd"))
    ++count;
  return count;
}

/// Whether a process that was told to end does so.
bool Ends(pid_t process) {
  const FileDescriptor descriptor(static_cast<int>(syscall(SYS_pidfd_open, process, 0)));
  if (!descriptor.valid()) return errno == ESRCH;
  pollfd wait{descriptor.get(), POLLIN, 0};
  return poll(&wait, 1, static_cast<int>(kLong.count())) == 1;
}

TEST(RemoteControl, GivesTheRepliesOfTheOtherEnd) {
  const RemoteAnswer done = AskShell("printf 'done\\ntwo\\nlines'");
  ASSERT_TRUE(done.reply) << done.problem;
  EXPECT_EQ(done.reply->outcome, ControlOutcome::kDone);
  EXPECT_EQ(done.reply->text, "two\nlines");
  EXPECT_EQ(done.problem, "");
  EXPECT_EQ(AskShell("printf 'failed\\nno room'").reply->outcome, ControlOutcome::kFailed);
  EXPECT_EQ(AskShell("printf 'wrong\\nwhat?'").reply->outcome, ControlOutcome::kWrong);
}

TEST(RemoteControl, TheRequestComesAsStandardInputAndEnds) {
  const RemoteAnswer answer = AskShell("echo done; cat", kLong, "record start walk-01");
  ASSERT_TRUE(answer.reply) << answer.problem;
  EXPECT_EQ(answer.reply->text, "record start walk-01");
}

TEST(RemoteControl, NoShellReadsTheCommand) {
  const RemoteAnswer answer =
      RemoteControl("left", {"printf", "%s", "done\n$HOME `id` ; id"}).Ask("status", kLong);
  ASSERT_TRUE(answer.reply) << answer.problem;
  EXPECT_EQ(answer.reply->text, "$HOME `id` ; id");
}

TEST(RemoteControl, WhoNeverAnswersIsEndedAtTheDeadline) {
  const RemoteAnswer answer = AskShell("exec sleep 1000", kShort);
  EXPECT_FALSE(answer.reply);
  EXPECT_EQ(answer.problem, "left: has not answered for 0.05 s");
  EXPECT_FALSE(HasChildren());
}

TEST(RemoteControl, AnAnswerThatDoesNotEndIsNone) {
  EXPECT_FALSE(AskShell("echo done; exec sleep 1000", kShort).reply);
  EXPECT_FALSE(AskShell("echo done; exec >&-; exec sleep 1000", kShort).reply);
}

TEST(RemoteControl, WhoFloodsIsEndedAndNamed) {
  EXPECT_EQ(AskShell("exec yes").problem, "left: its answer is longer than 65536 bytes");
  EXPECT_THAT(AskShell("exec yes >&2", kShort).problem,
              StartsWith("left: has not answered for 0.05 s"));
  EXPECT_FALSE(HasChildren());
}

TEST(RemoteControl, TheLongestReplyIsTakenWhole) {
  const std::string text(kLongestReply - 5, 'x');
  const testing::TemporaryFolder folder;
  testing::WriteText(folder.path() / "reply", "done\n" + text);
  const RemoteAnswer answer = AskShell("exec cat " + (folder.path() / "reply").string());
  ASSERT_TRUE(answer.reply) << answer.problem;
  EXPECT_EQ(answer.reply->text, text);
}

TEST(RemoteControl, WhatSshSaysLastIsTheReason) {
  EXPECT_EQ(AskShell("echo 'Warning: added a host' >&2;"
                     "printf 'studio@left: Permission denied (publickey).\\r\\n' >&2; exit 255")
                .problem,
            "left: studio@left: Permission denied (publickey).");
  EXPECT_EQ(AskShell("exit 255").problem, "left: /bin/sh ended with status 255");
  EXPECT_EQ(AskShell("kill -9 $$").problem, "left: /bin/sh was killed by signal 9");
  EXPECT_THAT(AskShell("printf 'a\\033[2Jb' >&2; exit 1").problem, HasSubstr("a\\x1b[2Jb"));
}

TEST(RemoteControl, AReplyThatBrokeOffIsNone) {
  const RemoteAnswer answer =
      AskShell("printf 'done\\nhalf of'; echo 'Connection to left closed' >&2; exit 255");
  EXPECT_FALSE(answer.reply);
  EXPECT_EQ(answer.problem, "left: Connection to left closed");
}

TEST(RemoteControl, WhatIsNoReplyIsToldAsItIs) {
  EXPECT_EQ(AskShell("echo Welcome to left; echo done").problem,
            "left: its answer is not a valid reply: \"Welcome to left\"");
  EXPECT_EQ(AskShell("true").problem, "left: gave no answer");
}

TEST(RemoteControl, ASecondAnswerChangesNothingOfTheFirst) {
  const RemoteAnswer answer = AskShell("printf 'failed\\nno room\\n'; printf 'done\\nall is good'");
  ASSERT_TRUE(answer.reply) << answer.problem;
  EXPECT_EQ(answer.reply->outcome, ControlOutcome::kFailed);
  EXPECT_THAT(answer.reply->text, StartsWith("no room\n"));
}

TEST(RemoteControl, ACommandThatIsNotThereIsNamed) {
  EXPECT_EQ(RemoteControl("left", {"/no/such/ssh"}).Ask("status", kLong).problem,
            "left: /no/such/ssh cannot be started: No such file or directory");
}

TEST(RemoteControl, WhoDoesNotReadTheRequestDoesNoHarm) {
  EXPECT_TRUE(AskShell("exec <&-; echo done").reply);
}

TEST(RemoteControl, WhatTheCommandHasStartedEndsWithIt) {
  const RemoteAnswer answer = AskShell("sleep 1000 & echo $! >&2; exit 1");
  ASSERT_THAT(answer.problem, StartsWith("left: "));
  EXPECT_TRUE(Ends(std::stoi(answer.problem.substr(6))));
  // It also holds the pipes open, for which nobody waits.
  EXPECT_TRUE(AskShell("sleep 1000 & echo done").reply);
}

TEST(RemoteControl, NoFilesAreLeftOpenAndNoneAreHandedOn) {
  const FileDescriptor ours(open("/dev/null", O_RDONLY));
  AskShell("echo done");
  const std::size_t before = OpenFiles();
  for (const char* script : {"echo done", "exit 1", "exec yes"}) AskShell(script);
  RemoteControl("left", {"/no/such/ssh"}).Ask("status", kLong);
  EXPECT_EQ(OpenFiles(), before);
  const RemoteAnswer answer = AskShell("echo done; ls /proc/self/fd");
  ASSERT_TRUE(answer.reply) << answer.problem;
  // The fourth is the folder that is listed.
  EXPECT_EQ(answer.reply->text, "0\n1\n2\n3\n");
}

TEST(RemoteControl, SignalsThatAreHeldBackHereEndTheCommand) {
  sigset_t signals, before;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, &before);
  const RemoteAnswer answer = AskShell("kill -TERM $$; exec sleep 1000");
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  EXPECT_EQ(answer.problem, "left: /bin/sh was killed by signal 15");
}

TEST(RemoteControl, NodesAreAskedAtTheSameTime) {
  const testing::TemporaryFolder folder;
  const std::string meeting = (folder.path() / "meeting").string();
  ASSERT_EQ(mkfifo(meeting.c_str(), 0600), 0);
  // Each waits for the other.
  const RemoteControl left("left", {"/bin/sh", "-c", "echo hello >" + meeting + "; echo done"});
  const RemoteControl right("right", {"/bin/sh", "-c", "echo done; cat " + meeting});
  std::future<RemoteAnswer> of_left = left.AskBeside("status", kLong);
  std::future<RemoteAnswer> of_right = right.AskBeside("status", kLong);
  EXPECT_TRUE(of_left.get().reply);
  EXPECT_EQ(of_right.get().reply->text, "hello\n");
}

TEST(RemoteControl, TellsWhatTheRealSshSaysOfAClosedPort) {
  if (!std::filesystem::exists("/usr/bin/ssh")) GTEST_SKIP() << "openssh-client is not installed";
  const RemoteControl nobody(
      "left", {"/usr/bin/ssh", "-F", "none", "-o", "BatchMode=yes", "-p", "1", "127.0.0.1"});
  EXPECT_THAT(nobody.Ask("status", kLong).problem, HasSubstr("Connection refused"));
}

}  // namespace
}  // namespace mocap
