// Which mocapd the commands ask, of several on one host.
#include "tools/control.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/errors.h"
#include "daemon/control/control_socket.h"
#include "tests/support/run_command.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

class ControlCommands : public ::testing::Test {
 protected:
  /// @param failure  set to the error; null: there must be none.
  std::string Said(const std::string& command_line, std::string* failure = nullptr) {
    ::testing::internal::CaptureStdout();
    try {
      testing::RunCommand(AddControlCommands, command_line);
    } catch (const std::runtime_error& error) {
      if (!failure) throw;
      *failure = error.what();
    }
    return ::testing::internal::GetCapturedStdout();
  }

  testing::TemporaryFolder folder_;
  const std::filesystem::path left_ = folder_.path() / "left.toml";
};

TEST_F(ControlCommands, AskTheDaemonOfTheNamedConfiguration) {
  testing::WriteText(left_, "[control]\nsocket = \"left.socket\"\n");
  const ControlServer server(folder_.path() / "left.socket", [](const ControlRequest&) {
    return ControlReply{ControlOutcome::kDone, "of left\n"};
  });
  for (const char* command : {"status", "record stop", "subject list", "reload"}) {
    EXPECT_EQ(Said(command + (" --config " + left_.string())), "of left\n") << command;
  }
  EXPECT_EQ(Said("record start --config " + left_.string() + " walk"), "of left\n");
}

TEST_F(ControlCommands, WhatWasDoneIsPrintedAndOnlyWhatFailedIsTheError) {
  const std::string socket = folder_.path() / "control";
  const ControlServer server(socket, [](const ControlRequest&) {
    return ControlReply{ControlOutcome::kFailed,
                        "takes/walk: 4 s\nnode left: 4 s\nnode right: gone"};
  });
  std::string failure;
  EXPECT_EQ(Said("record stop --socket " + socket, &failure), "takes/walk: 4 s\nnode left: 4 s\n");
  EXPECT_EQ(failure, "node right: gone");
}

TEST_F(ControlCommands, AConfigurationWithoutASocketIsOfTheUsersOwnDaemon) {
  testing::WriteText(left_, "");
  unsetenv("RUNTIME_DIRECTORY");
  setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
  std::filesystem::create_directory(folder_.path() / "mocapd");
  const ControlServer server(folder_.path() / "mocapd" / "control", [](const ControlRequest&) {
    return ControlReply{ControlOutcome::kDone, "of the user\n"};
  });
  EXPECT_EQ(Said("status --config " + left_.string()), "of the user\n");
  unsetenv("XDG_RUNTIME_DIR");
  EXPECT_THAT(testing::SetupErrorOf([&] {
                testing::RunCommand(AddControlCommands, "status --config " + left_.string());
              }),
              ::testing::HasSubstr("has no control.socket"));
}

TEST_F(ControlCommands, TwoWaysToNameADaemonAreOneTooMany) {
  testing::WriteText(left_, "[control]\nsocket = \"left.socket\"\n");
  EXPECT_THROW(
      testing::RunCommand(AddControlCommands, "status --socket x --config " + left_.string()),
      CLI::ExcludesError);
}

TEST_F(ControlCommands, AConfigurationThatIsNotThereIsNamed) {
  try {
    testing::RunCommand(AddControlCommands, "status --config " + left_.string());
    FAIL();
  } catch (const SetupError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("left.toml"));
  }
}

}  // namespace
}  // namespace mocap
