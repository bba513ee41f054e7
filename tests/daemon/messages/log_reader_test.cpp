#include "daemon/messages/log_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/errors.h"
#include "daemon/recording/message_log.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class LogReaderTest : public ::testing::Test {
 protected:
  /// Four messages, of which the second begins at SecondPlace().
  void SetUp() override {
    MessageLog log(file_);
    for (const char* text : {"one", "two", "three", "four"}) {
      const std::string data = text;
      log.Write({.channel = "A", .bytes = {data.begin(), data.end()}, .utime = 7});
    }
    log.Flush();
  }

  std::vector<std::string> Read() {
    LogReader reader(file_);
    LoggedMessage message;
    std::vector<std::string> texts;
    while (reader.Next(message)) texts.emplace_back(message.bytes.begin(), message.bytes.end());
    damaged_bytes_ = reader.damaged_bytes();
    damaged_places_ = reader.damaged_places();
    return texts;
  }

  void Change(std::size_t place, const std::string& bytes) {
    std::string log = testing::ReadText(file_);
    testing::WriteText(file_, log.replace(place, bytes.size(), bytes));
  }

  static constexpr std::size_t kHead = 28, kSecond = kHead + 1 + 3;
  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "log.lcm";
  std::int64_t damaged_bytes_ = 0, damaged_places_ = 0;
};

TEST_F(LogReaderTest, GivesEveryMessage) {
  EXPECT_THAT(Read(), ElementsAre("one", "two", "three", "four"));
  EXPECT_EQ(damaged_bytes_, 0);
  LogReader reader(file_);
  LoggedMessage message;
  ASSERT_TRUE(reader.Next(message) && reader.Next(message));
  EXPECT_EQ(message.channel, "A");
  EXPECT_EQ(message.number, 1);
  EXPECT_EQ(message.utime, 7);
}

TEST_F(LogReaderTest, GoesOnBehindDamageAndCountsIt) {
  Change(kSecond, "xxxx");
  EXPECT_THAT(Read(), ElementsAre("one", "three", "four"));
  EXPECT_EQ(damaged_places_, 1);
  EXPECT_EQ(damaged_bytes_, static_cast<std::int64_t>(kHead + 1 + 3));
}

TEST_F(LogReaderTest, LengthsThatCannotBeCostTheirMessageAlone) {
  const std::size_t data_length = kSecond + 24, channel_length = kSecond + 20;
  for (const std::string& length :
       {std::string("\x7f\xff\xff\xff", 4), std::string("\x80\0\0\0", 4),
        std::string("\xff\xff\xff\xff", 4), std::string("\0\0\0\x05", 4)}) {
    SetUp();
    Change(data_length, length);
    EXPECT_THAT(Read(), ElementsAre("one", "three", "four"));
    SetUp();
    Change(channel_length, length);
    EXPECT_THAT(Read(), ElementsAre("one", "three", "four"));
    EXPECT_EQ(damaged_places_, 1);
  }
}

TEST_F(LogReaderTest, ALogThatWasCutOffIsReadUpToItsLastWholeMessage) {
  const std::string whole = testing::ReadText(file_);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    testing::WriteText(file_, whole.substr(0, size));
    const std::vector<std::string> texts = Read();
    EXPECT_EQ(texts.size(), size < kSecond           ? 0u
                            : size < 2 * kSecond     ? 1u
                            : size < 3 * kSecond + 2 ? 2u
                                                     : 3u)
        << size;
  }
}

TEST_F(LogReaderTest, MarksAcrossTheEndsOfBuffersAreFound) {
  const std::string whole = testing::ReadText(file_);
  for (std::size_t noise = (1 << 16) - 6; noise < (1 << 16) + 6; ++noise) {
    testing::WriteText(file_, std::string(noise, 'x') + whole);
    EXPECT_EQ(Read().size(), 4u) << noise;
    EXPECT_EQ(damaged_bytes_, static_cast<std::int64_t>(noise));
  }
}

TEST_F(LogReaderTest, WhatIsNoLogHoldsNothing) {
  testing::WriteText(file_, "no log at all\n");
  EXPECT_THAT(Read(), IsEmpty());
  EXPECT_EQ(damaged_bytes_, 14);
  EXPECT_THROW(LogReader(folder_.path()), SetupError);
  EXPECT_THROW(LogReader(folder_.path() / "absent"), SetupError);
}

}  // namespace
}  // namespace mocap
