#include "daemon/pipeline/moment_history.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

/// A moment that can be told from others.
SeenMoment Numbered(std::int64_t set) {
  SeenShape shape;
  shape.height_share = static_cast<double>(set);
  return {shape};
}

TEST(MomentHistory, SpreadsOverTheWholeTakeWhateverItsLength) {
  for (const std::int64_t sets : {1, 10, 100, 1000, 54321}) {
    MomentHistory history;
    for (std::int64_t set = 0; set < sets; ++set) {
      if (history.Wants(set)) history.Add(Numbered(set));
    }
    const auto moments = history.moments();
    EXPECT_LT(moments.size(), MomentHistory::kMost);
    EXPECT_GE(moments.size(), std::min<std::size_t>(sets, MomentHistory::kMost / 2));
    const auto number = [&](std::size_t i) { return moments[i][0]->height_share; };
    EXPECT_EQ(number(0), 0);
    for (std::size_t i = 2; i < moments.size(); ++i)
      EXPECT_EQ(number(i) - number(i - 1), number(1) - number(0));
    EXPECT_GE(number(moments.size() - 1), 0.9 * static_cast<double>(sets - 1) - 1);
  }
}

}  // namespace
}  // namespace mocap
