#include "config/lcm_url.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

TEST(LcmUrl, TakesApartWhatLcmKnows) {
  const LcmUrl usual = ParseLcmUrl("udpm://239.255.76.67:7667?ttl=0");
  EXPECT_EQ(usual.provider, LcmProvider::kMulticast);
  EXPECT_EQ(usual.host, "239.255.76.67");
  EXPECT_EQ(usual.port, 7667);
  EXPECT_EQ(ParseLcmUrl("udpm://").port, 7667) << "LCM's default";
  EXPECT_EQ(ParseLcmUrl("udpm://239.0.0.1:1?ttl=255&recv_buf_size=100000").host, "239.0.0.1");
  EXPECT_EQ(ParseLcmUrl("mpudpm://239.255.76.67:7667?nports=10").provider, LcmProvider::kMulticast);
  EXPECT_EQ(ParseLcmUrl("tcpq://host:77").host, "host");
  EXPECT_EQ(ParseLcmUrl("tcpq://").port, 7700);
  EXPECT_EQ(ParseLcmUrl("memq://").provider, LcmProvider::kMemory);
  const LcmUrl log = ParseLcmUrl("file:///tmp/x.lcm?mode=w");
  EXPECT_EQ(log.file, "/tmp/x.lcm");
  EXPECT_TRUE(log.is_written);
  EXPECT_FALSE(ParseLcmUrl("file:///tmp/x.lcm").is_written) << "LCM's default is to read";
  EXPECT_EQ(ParseLcmUrl("file:///tmp/x.lcm").speed, 1);
  EXPECT_EQ(ParseLcmUrl("file:///tmp/x.lcm?speed=0.5").speed, 0.5);
}

TEST(LcmUrl, MessagesStayOnThisComputerUnlessATtlLetsThemLeave) {
  EXPECT_EQ(ParseLcmUrl("udpm://").hops, 0);
  EXPECT_EQ(ParseLcmUrl("udpm://239.255.76.67:7667?ttl=0").hops, 0);
  EXPECT_EQ(ParseLcmUrl("mpudpm://239.255.76.67:7667?recv_buf_size=9&ttl=16").hops, 16);
}

TEST(LcmUrl, RefusesWhatLcmPassesOver) {
  const std::pair<const char*, const char*> wrong[] = {
      {"udpm:239.255.76.67:7667", "is not an LCM address"},
      {"updm://239.255.76.67:7667", "begins with updm"},
      {"udpm://192.168.1.5:7667", "is not a multicast address"},
      {"udpm://239.255.76.67", "no address with a port"},
      {"udpm://239.255.76.67:0", "no address with a port"},
      {"udpm://239.255.76.67:99999", "no address with a port"},
      {"udpm://239.255.76.67:7667?ttl=300", "a number of 0 to 255"},
      {"udpm://239.255.76.67:7667?ttl=-1", "a number of 0 to 255"},
      {"udpm://239.255.76.67:7667?ttl=", "a number of 0 to 255"},
      {"udpm://239.255.76.67:7667?tll=1",
       "unknown option \"tll\"; did you mean ttl? Expected ttl or"},
      {"udpm://239.255.76.67:7667?nports=3", "unknown option \"nports\"; expected ttl or"},
      {"tcpq://host", "no address with a port"},
      {"tcpq://[::1]:7700", "LCM knows only IPv4"},
      {"udpm://[ff02::1]:7667", "LCM knows only IPv4"},
      {"file://?mode=w", "has no file name"},
      {"file:///tmp/x?mode=x", "mode=x"},
      {"file:///tmp/x?speed=fast", "speed=fast"},
      {"file:///tmp/x?speed=-1", "speed=-1"},
      {"file:///tmp/x?speed=nan", "speed=nan"},
      {"file:///tmp/x?speed=1e-9", "speed=1e-9"},
      {"memq://?ttl=0", "has options"}};
  for (const auto& [url, what] : wrong) {
    try {
      ParseLcmUrl(url);
      ADD_FAILURE() << url;
    } catch (const SetupError& error) {
      EXPECT_THAT(error.what(), HasSubstr(what)) << url;
      EXPECT_THAT(error.what(), HasSubstr(url));
    }
  }
}

}  // namespace
}  // namespace mocap
