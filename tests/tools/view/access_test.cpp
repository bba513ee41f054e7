#include "tools/view/access.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

TEST(Access, OnlyThisMachinesOwnNamesAreItsHost) {
  for (const char* host :
       {"127.0.0.1", "127.0.0.1:8077", "localhost:9000", "[::1]:8077", "[::1]"}) {
    EXPECT_TRUE(IsOwnHost(host)) << host;
  }
  for (const char* host : {"", "evil.example", "evil.example:8077", "127.0.0.1.evil.example",
                           "localhost.evil.example:8077", "127.0.0.1:80x", "192.168.1.4:8077"}) {
    EXPECT_FALSE(IsOwnHost(host)) << host;
  }
}

constexpr RequestSource kOwnPage{"127.0.0.1:8077", "http://127.0.0.1:8077", "same-origin", "cors"};

TEST(Access, ThePageAndProgramsMayAsk) {
  EXPECT_TRUE(IsFromOwnPage(kOwnPage, false));
  EXPECT_TRUE(IsFromOwnPage({"127.0.0.1:8077", "", "", ""}, false));
  EXPECT_TRUE(IsFromOwnPage({"127.0.0.1:8077", "", "none", "navigate"}, true));
}

TEST(Access, APageOfAnotherOriginMayNot) {
  for (const char* origin : {"http://evil.example", "https://127.0.0.1:8077", "null",
                             "http://127.0.0.1:8078", "http://localhost:8077"}) {
    EXPECT_FALSE(IsFromOwnPage({"127.0.0.1:8077", origin, "", ""}, false)) << origin;
  }
  for (const char* site : {"cross-site", "same-site"}) {
    EXPECT_FALSE(IsFromOwnPage({"127.0.0.1:8077", "", site, "no-cors"}, false)) << site;
    EXPECT_FALSE(IsFromOwnPage({"127.0.0.1:8077", "", site, "no-cors"}, true)) << site;
  }
}

TEST(Access, ALinkOnAnotherPageLeadsToThePageAndToNoData) {
  const RequestSource link{"127.0.0.1:8077", "", "cross-site", "navigate"};
  EXPECT_TRUE(IsFromOwnPage(link, true));
  EXPECT_FALSE(IsFromOwnPage(link, false));
}

TEST(Access, TokensAreLongAndEachIsNew) {
  EXPECT_EQ(MakeToken().size(), 32u);
  EXPECT_NE(MakeToken(), MakeToken());
}

TEST(Access, OnlyTheWholeTokenCounts) {
  EXPECT_TRUE(HoldsToken("Bearer abc", "abc"));
  for (const char* given : {"", "abc", "Bearer ", "Bearer ab", "Bearer abcd", "Bearer abd",
                            "bearer abc", "Basic abc"}) {
    EXPECT_FALSE(HoldsToken(given, "abc")) << given;
  }
  EXPECT_FALSE(HoldsToken("Bearer ", ""));
}

}  // namespace
}  // namespace mocap
