// Copies of coded pictures.
#include "drivers/take/video_copy.h"

#include <gtest/gtest.h>

#include "core/errors.h"
#include "drivers/take/video_index.h"
#include "drivers/take/video_reader.h"
#include "tests/support/dependent_video.h"
#include "tests/support/telephone_video.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

std::vector<std::uint8_t> PixelsOf(const std::filesystem::path& file) {
  VideoReader video(file);
  std::vector<std::uint8_t> pixels;
  ImageView<const Bgr> image;
  while (video.Read(image) == VideoStatus::kFrame)
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) pixels.push_back(image(x, y).g);
  return pixels;
}

TEST(CopyVideo, KeepsPicturesTimesAndRotation) {
  const testing::TemporaryFolder folder;
  const auto from = folder.path() / "phone.mov", to = folder.path() / "cam1.mkv";
  testing::WriteTelephoneVideo(from, {0, 33, 70, 99, 400}, testing::kHeldUpright);
  const PictureTurn turn = VideoReader(from).turn();
  ASSERT_TRUE(CopyVideo(from, to, turn));
  EXPECT_EQ(VideoReader(to).turn(), turn);
  EXPECT_EQ(PixelsOf(to), PixelsOf(from));
  EXPECT_EQ(ReadVideoIndex(to).times_ns, ReadVideoIndex(from).times_ns);
}

TEST(CopyVideo, LeavesMirroredPictures) {
  const testing::TemporaryFolder folder;
  const auto from = folder.path() / "phone.mov", to = folder.path() / "cam1.mkv";
  testing::WriteTelephoneVideo(from, {0, 33}, testing::kHeldUpright);
  EXPECT_FALSE(CopyVideo(from, to, PictureTurn{-1, 0, 0, 1}));
  EXPECT_FALSE(std::filesystem::exists(to));
}

TEST(CopyVideo, CanEnd) {
  const testing::TemporaryFolder folder;
  const auto from = folder.path() / "phone.mov";
  testing::WriteTelephoneVideo(from, {0, 33}, testing::kHeldUpright);
  const auto stop = [] { throw SetupError("stopped"); };
  EXPECT_THROW(CopyVideo(from, folder.path() / "cam1.mkv", {}, stop), SetupError);
}

TEST(VideoReader, GoesToATime) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "long.mkv";
  constexpr int kFrames = 400;  // 16 s at 25 Hz, a key frame every 5.
  testing::WriteVideoOfDependentFrames(file, 64, 32, kFrames);
  VideoReader video(file);
  ImageView<const Bgr> image;
  for (const int frame : {3, 120, 121, 399, 7}) {
    ASSERT_TRUE(video.GoTo(std::int64_t{frame} * 40'000'000)) << frame;
    ASSERT_EQ(video.Read(image), VideoStatus::kFrame) << frame;
    EXPECT_EQ(image(5, 9).g, testing::NoiseAt(frame, 5, 9)) << frame;
  }
  EXPECT_FALSE(video.GoTo(std::int64_t{kFrames} * 40'000'000));
  video.Rewind();
  ASSERT_EQ(video.Read(image), VideoStatus::kFrame);
  EXPECT_EQ(image(5, 9).g, testing::NoiseAt(0, 5, 9));
}

}  // namespace
}  // namespace mocap
