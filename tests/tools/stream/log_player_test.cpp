#include "tools/stream/log_player.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "daemon/recording/message_log.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::SetupErrorOf;

constexpr std::chrono::hours kVeryLong{1};

class LogPlayerTest : public ::testing::Test {
 protected:
  void Write(const std::vector<std::int64_t>& utimes) {
    MessageLog log(file_);
    for (const std::int64_t utime : utimes) {
      const std::string data = std::to_string(utime);
      log.Write({.channel = "A", .bytes = {data.begin(), data.end()}, .utime = utime});
    }
    log.Flush();
  }
  void Subscribe(LogPlayer& player) {
    player.lcm().subscribe("A", &LogPlayerTest::OnMessage, this);
  }
  std::vector<std::string> PlayAll(double speed) {
    LogPlayer player(file_, speed);
    Subscribe(player);
    while (player.Play(kVeryLong)) {
    }
    return heard_;
  }

  testing::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "log.lcm";
  std::vector<std::string> heard_;

 private:
  void OnMessage(const lcm::ReceiveBuffer* buffer, const std::string&) {
    heard_.emplace_back(static_cast<const char*>(buffer->data), buffer->data_size);
  }
};

TEST_F(LogPlayerTest, HandsOnEveryMessageInItsOrder) {
  Write({5, 6, 7, 3});
  EXPECT_THAT(PlayAll(1), ElementsAre("5", "6", "7", "3"));
}

TEST_F(LogPlayerTest, TimesThatAreNoneHoldUpNothing) {
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  Write({5, 3'600'000'000, kLast, -kLast, kLast});
  EXPECT_EQ(PlayAll(0).size(), 5u);
  EXPECT_EQ(PlayAll(1e6).size(), 10u);
}

TEST_F(LogPlayerTest, AMessageWhoseTurnHasNotComeIsKept) {
  Write({5, 3'600'000'000});
  LogPlayer player(file_, 1);
  Subscribe(player);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(player.Play(std::chrono::nanoseconds(0)));
  EXPECT_THAT(heard_, ElementsAre("5"));
}

TEST_F(LogPlayerTest, DamageCostsWhatIsDamaged) {
  Write({11, 22, 33});
  constexpr std::size_t kEvent = 28 + 1 + 2;
  std::string log = testing::ReadText(file_);
  log.replace(kEvent + 24, 4, "\x7f\xff\xff\xff");
  testing::WriteText(file_, log);
  EXPECT_THAT(PlayAll(0), ElementsAre("11", "33"));
}

TEST_F(LogPlayerTest, WhatIsNoLogIsTold) {
  EXPECT_THAT(SetupErrorOf([&] { PlayAll(0); }), HasSubstr("LCM log"));
  for (const char* text : {"", "frame,timestamp_ns"}) {
    testing::WriteText(file_, text);
    EXPECT_THAT(SetupErrorOf([&] { PlayAll(0); }), HasSubstr("is not an LCM log"));
  }
}

}  // namespace
}  // namespace mocap
