// What a video file says of itself.
#include "drivers/take/video_index.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/errors.h"
#include "tests/support/telephone_video.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

TEST(VideoIndex, HasTheTimeOfEachPicture) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "phone.mov";
  testing::WriteTelephoneVideo(file, {0, 33, 70, 99, 400}, testing::kHeldUpright);
  const VideoIndex index = ReadVideoIndex(file);
  EXPECT_EQ(index.times_ns,
            (std::vector<std::int64_t>{0, 33'000'000, 70'000'000, 99'000'000, 400'000'000}));
  EXPECT_FALSE(index.has_sound);
  EXPECT_EQ(index.timecode, "");
}

TEST(VideoIndex, RefusesWhatIsNoVideo) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "text.mp4";
  EXPECT_THROW(ReadVideoIndex(file), SetupError);
  std::ofstream(file) << "no video\n";
  EXPECT_THROW(ReadVideoIndex(file), SetupError);
}

TEST(Timecode, CountsFramesOfItsRate) {
  EXPECT_EQ(TimeOfTimecode("00:00:00:00", 25), 0);
  EXPECT_EQ(TimeOfTimecode("01:00:00:05", 25), 3600 * kSecond + kSecond / 5);
}

TEST(Timecode, LeavesOutNumbersInDropFrame) {
  // SMPTE 12M: 17982 frames in ten minutes of 30000/1001 Hz.
  const auto time_ns = TimeOfTimecode("00:10:00;00", 30000.0 / 1001);
  ASSERT_TRUE(time_ns);
  EXPECT_NEAR(static_cast<double>(*time_ns), 17982 * 1001 / 30000.0 * kSecond, 1e6);
}

TEST(Timecode, CountsTheNearestWholeRate) {
  // A phone that misses pictures; Matroska's rounded times.
  EXPECT_EQ(TimeOfTimecode("01:00:00:12", 30.02), 3600 * kSecond + 12 * kSecond / 30);
  EXPECT_EQ(TimeOfTimecode("01:00:00:12", 24.99), 3600 * kSecond + 12 * kSecond / 25);
}

TEST(UsualRate, DoesNotCountGapsNorRounding) {
  std::vector<std::int64_t> times_ns;
  for (int i = 0; i < 300; ++i)
    if (i % 7 != 3) times_ns.push_back(std::int64_t{(1000 * i + 15) / 30} * 1'000'000);
  EXPECT_NEAR(UsualRateHz(times_ns), 30, 0.05);
  EXPECT_EQ(UsualRateHz(std::span(times_ns).first(1)), 0);
}

TEST(Timecode, IsNoneInOtherText) {
  EXPECT_FALSE(TimeOfTimecode("", 25));
  EXPECT_FALSE(TimeOfTimecode("noon", 25));
  EXPECT_FALSE(TimeOfTimecode("01:00:00:00", 0));
}

TEST(CreationTime, ReadsWhatCamerasWrite) {
  const auto whole = CreationTimeFromText("1970-01-02T00:00:01.000000Z");
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->epoch_ns, 86401 * kSecond);
  EXPECT_TRUE(whole->is_whole_second);
  const auto parts = CreationTimeFromText("1970-01-02T00:00:01.250000Z");
  ASSERT_TRUE(parts);
  EXPECT_EQ(parts->epoch_ns, 86401 * kSecond + kSecond / 4);
  EXPECT_FALSE(parts->is_whole_second);
}

TEST(CreationTime, ReadsTimeZones) {
  for (const char* text :
       {"1970-01-02T01:00:00+0100", "1970-01-02T01:00:00+01:00", "1970-01-01T19:00:00-0500"}) {
    const auto time = CreationTimeFromText(text);
    ASSERT_TRUE(time) << text;
    EXPECT_EQ(time->epoch_ns, 86400 * kSecond) << text;
  }
}

TEST(CreationTime, IsNoneInOtherText) {
  for (const char* text :
       {"", "yesterday", "1970-01-02", "1970-01-02T01:00:00?0100", "1970-01-02T01:00:00+1"})
    EXPECT_FALSE(CreationTimeFromText(text)) << text;
}

}  // namespace
}  // namespace mocap
