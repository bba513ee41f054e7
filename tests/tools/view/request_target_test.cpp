#include "tools/view/request_target.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

TEST(RequestTarget, HasAPathAndAQuery) {
  const RequestTarget target = ParseRequestTarget("/poses.bin?result=truth&from=12&count");
  EXPECT_EQ(target.path, "/poses.bin");
  EXPECT_EQ(target.query.at("result"), "truth");
  EXPECT_EQ(target.query.at("from"), "12");
  EXPECT_EQ(target.query.at("count"), "");
}

TEST(RequestTarget, DecodesTheQueryAndLeavesThePath) {
  const RequestTarget target = ParseRequestTarget("/%2e%2e/x?a=%41%zz%4&b=1%");
  EXPECT_EQ(target.path, "/%2e%2e/x");
  EXPECT_EQ(target.query.at("a"), "A%zz%4");
  EXPECT_EQ(target.query.at("b"), "1%");
}

TEST(RequestTarget, OddOnesAreTakenAsTheyAre) {
  EXPECT_EQ(ParseRequestTarget("").path, "");
  EXPECT_EQ(ParseRequestTarget("?").query.size(), 0u);
  EXPECT_EQ(ParseRequestTarget("/?&&=&a=b=c").query.at("a"), "b=c");
}

}  // namespace
}  // namespace mocap
