// Pictures that are spread over a video.
#include "tools/import/sampled_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/support/telephone_video.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

std::vector<std::size_t> All(std::size_t count) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

TEST(SpreadFrames, AreAllIfThereAreFew) {
  // Matroska rounds times to milliseconds.
  std::vector<std::int64_t> times_ns;
  for (int i = 0; i < 40; ++i) times_ns.push_back(std::int64_t{1000 * i / 30} * 1'000'000);
  EXPECT_EQ(SpreadFrames(times_ns, 50), All(40));
  EXPECT_EQ(SpreadFrames(times_ns, 40), All(40));
  EXPECT_TRUE(SpreadFrames({}, 50).empty());
}

TEST(SpreadFrames, GoByTime) {
  // Slow at first, then fast.
  const std::vector<std::int64_t> times_ns = {0, 100, 200, 210, 220, 230, 240, 300, 400};
  EXPECT_EQ(SpreadFrames(times_ns, 5), (std::vector<std::size_t>{0, 1, 2, 7, 8}));
  EXPECT_EQ(SpreadFrames(times_ns, 1), (std::vector<std::size_t>{0}));
}

TEST(SpreadFrames, AreNeverTheSame) {
  std::vector<std::int64_t> times_ns = {0};
  for (int i = 0; i < 20; ++i) times_ns.push_back(1'000'000 + i);
  const std::vector<std::size_t> chosen = SpreadFrames(times_ns, 10);
  EXPECT_EQ(chosen.size(), 10u);
  EXPECT_TRUE(std::ranges::is_sorted(chosen));
  EXPECT_EQ(std::ranges::adjacent_find(chosen), chosen.end());
  EXPECT_LT(chosen.back(), times_ns.size());
}

TEST(VisitFrames, ShowsTheChosenOnesUntilToldToEnd) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "phone.mov";
  const std::vector<std::int64_t> times_ms = {0, 33, 70, 99, 4000, 4030, 9000};
  testing::WriteTelephoneVideo(file, times_ms, testing::kHeldUpright);
  std::vector<std::int64_t> times_ns;
  for (const std::int64_t time_ms : times_ms) times_ns.push_back(time_ms * 1'000'000);
  std::vector<std::size_t> seen;
  const std::vector<std::size_t> chosen = {1, 3, 5, 6};
  VisitFrames(file, times_ns, chosen, [&](std::size_t frame, ImageView<const Bgr> picture) {
    EXPECT_EQ(picture.width(), 32);
    seen.push_back(frame);
    return frame != 5;
  });
  EXPECT_EQ(seen, (std::vector<std::size_t>{1, 3, 5}));
}

}  // namespace
}  // namespace mocap
