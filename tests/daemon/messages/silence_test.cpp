#include "daemon/messages/silence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mocap {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class SilenceTest : public ::testing::Test {
 protected:
  void Send(const std::string& channel) {
    lcm_.publish(channel, "x", 1);
    while (lcm_.handleTimeout(0) > 0) {
    }
  }

  lcm::LCM lcm_{"memq://"};
};

TEST_F(SilenceTest, NobodySends) {
  const Silence silence(lcm_, "udpm://239.1.1.1:7667", "left.");
  Send("SOMETHING_ELSE");
  EXPECT_EQ(
      silence.Text(),
      "no messages arrive on udpm://239.1.1.1:7667: is mocapd running? mocap doctor checks the "
      "network");
}

TEST_F(SilenceTest, OthersSendWithoutAPrefix) {
  const Silence left(lcm_, "u", "left_");
  Send("MOCAP_STATUS");
  EXPECT_THAT(left.Text(), HasSubstr("sends there without a prefix: leave --prefix out"));
}

TEST_F(SilenceTest, OthersSendWithAnotherPrefix) {
  const Silence left(lcm_, "u", "left."), plain(lcm_, "u", "");
  Send("left_MOCAP_STATUS");
  EXPECT_EQ(left.Text(),
            "no messages with prefix \"left.\" arrive on u, but mocapd sends there with prefix "
            "\"left_\": choose it with --prefix");
  EXPECT_THAT(plain.Text(), HasSubstr("no messages without a prefix arrive on u, but mocapd"));
  Send("right_MOCAP_STATUS");
  EXPECT_THAT(left.Text(), HasSubstr("with the prefixes \"left_\", \"right_\""));
}

TEST_F(SilenceTest, OthersSendWithAndWithoutAPrefix) {
  const Silence left(lcm_, "u", "left_");
  Send("MOCAP_STATUS");
  Send("right_MOCAP_STATUS");
  EXPECT_THAT(left.Text(), HasSubstr("sends there without a prefix and with prefix \"right_\": "
                                     "choose it with --prefix"));
}

TEST_F(SilenceTest, TheDaemonItselfSendsNoPoses) {
  const Silence silence(lcm_, "u", "left_");
  Send("left_MOCAP_STATUS");
  EXPECT_EQ(silence.Text(),
            "mocapd sends its status on u, but no poses: mocap status says why; a node never sends "
            "poses, its studio does");
}

TEST_F(SilenceTest, StrangersDoNotFillTheMemory) {
  const Silence silence(lcm_, "u", "left_");
  for (int i = 0; i < 100; ++i) Send("x" + std::to_string(i) + "_MOCAP_STATUS");
  EXPECT_THAT(silence.Text(), HasSubstr("x7_"));
  EXPECT_THAT(silence.Text(), Not(HasSubstr("x8_")));
}

TEST_F(SilenceTest, StrangersDoNotHideTheOneThatIsWaitedFor) {
  const Silence silence(lcm_, "u", "left_");
  for (int i = 0; i < 100; ++i) Send("x" + std::to_string(i) + "_MOCAP_STATUS");
  Send("left_MOCAP_STATUS");
  EXPECT_THAT(silence.Text(), HasSubstr("mocapd sends its status on u"));
}

TEST_F(SilenceTest, WhoIsSilentMakesRoomForOthers) {
  std::int64_t now_ns = 0;
  const Silence silence(lcm_, "u", "left_", [&] { return now_ns; });
  for (int i = 0; i < 100; ++i) Send("x" + std::to_string(i) + "_MOCAP_STATUS");
  now_ns = Silence::kLimit_ns + 1;
  EXPECT_THAT(silence.Text(), HasSubstr("no messages arrive on u"));
  Send("right_MOCAP_STATUS");
  EXPECT_THAT(silence.Text(), HasSubstr("with prefix \"right_\""));
}

}  // namespace
}  // namespace mocap
