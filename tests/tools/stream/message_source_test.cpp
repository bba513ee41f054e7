#include "tools/stream/message_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "daemon/recording/message_log.h"
#include "tests/support/setup_error.h"
#include "tests/support/taken_port.h"
#include "tests/support/temporary_folder.h"
#include "tools/commands.h"
#include "tools/doctor_checks.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;
using testing::SetupErrorOf;
using ::testing::StartsWith;

constexpr std::chrono::hours kLong{1};

void Count(const lcm::ReceiveBuffer*, const std::string&, int* count) { ++*count; }

TEST(MessageSource, ALogIsHeardToItsEndAndThenIsOver) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "log.lcm";
  MessageLog log(file);
  for (const std::int64_t utime : {5, 6, 7})
    log.Write({.channel = "A", .bytes = {1}, .utime = utime});
  log.Flush();
  MessageSource source("file://" + file.string());
  int count = 0;
  source.lcm().subscribeFunction("A", &Count, &count);
  while (source.Handle(kLong)) {
  }
  EXPECT_TRUE(source.is_log());
  EXPECT_EQ(count, 3);
}

TEST(MessageSource, WhatCannotBeHeardIsRefusedByTheNameOfTheOption) {
  EXPECT_THAT(SetupErrorOf([] { MessageSource("file:///tmp/x?mode=w"); }),
              AllOf(StartsWith("--url: "), HasSubstr("expected mode=r")));
  EXPECT_THAT(SetupErrorOf([] { MessageSource("nonsense"); }), StartsWith("--url: "));
}

TEST(MessageSource, APortOfAnotherProgramIsNamedByWhateverListens) {
  const testing::TakenPort taken;
  const auto is_told = HasSubstr("UDP port " + taken.number() + " is in use by another program");
  for (const char* command : {"watch", "view", "stream json", "stream osc"}) {
    EXPECT_THAT(SetupErrorOf([&] {
                  CLI::App app("", "mocap");
                  AddCommands(app);
                  app.parse(std::string(command) + " --url " + taken.Url());
                }),
                is_told)
        << command;
  }
  EXPECT_THAT(CheckMessages(taken.Url()).what, is_told);
}

}  // namespace
}  // namespace mocap
