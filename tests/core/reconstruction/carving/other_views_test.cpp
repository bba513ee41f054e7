#include "core/reconstruction/carving/other_views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<std::size_t> OthersOf(std::size_t view, std::size_t views) {
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < views; ++i)
    if (IsOther(i, view, views)) others.push_back(i);
  return others;
}

TEST(OtherViews, UpTo32CamerasEachIsHeldAgainstAllOthers) {
  EXPECT_THAT(OthersOf(0, 1), IsEmpty());
  EXPECT_THAT(OthersOf(1, 4), ElementsAre(0, 2, 3));
  const std::vector<std::size_t> others = OthersOf(7, 32);
  EXPECT_THAT(others, SizeIs(31));
  EXPECT_EQ(std::ranges::count(others, 7u), 0);
}

TEST(OtherViews, OfMoreThereAreAsManyAllAroundAndEachIsHeldAgainstByAsMany) {
  for (const std::size_t views : {33, 63, 64}) {
    std::vector<int> times(views, 0);
    for (std::size_t view = 0; view < views; ++view) {
      const std::vector<std::size_t> others = OthersOf(view, views);
      EXPECT_EQ(others.size(), kMostOthers);
      EXPECT_EQ(std::ranges::count(others, view), 0);
      for (std::size_t i = 1; i < others.size(); ++i) EXPECT_LE(others[i] - others[i - 1], 4u);
      for (const std::size_t other : others) ++times[other];
    }
    EXPECT_THAT(times, ::testing::Each(static_cast<int>(kMostOthers)));
  }
}

}  // namespace
}  // namespace mocap
