#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>

#include "core/errors.h"
#include "drivers/take/video_reader.h"
#include "drivers/take/video_writer.h"
#include "tests/support/damage_video.h"
#include "tests/support/dependent_video.h"
#include "tests/support/images.h"
#include "tests/support/small_take.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using testing::CutFile;
using ::testing::HasSubstr;
using testing::SamePixels;
using testing::SmallPicture;
using testing::SmallTake;
using testing::TemporaryFolder;

constexpr int kFrames = 12;

class Video : public ::testing::Test {
 protected:
  void WriteVideo() {
    VideoWriter writer(file_, take_.width_px, take_.height_px, 25, VideoPixels::kBgr);
    for (int i = 0; i < kFrames; ++i) writer.Write(SmallPicture(take_, 0, i).view());
    writer.Finish();
  }

  // Reads to the end; every frame must be the one that was written as the `first + i`-th.
  static int CountAndCompare(VideoReader& reader, const SmallTake& take, int first = 0) {
    ImageView<const Bgr> image;
    int frames = 0;
    while (reader.Read(image) == VideoStatus::kFrame) {
      EXPECT_TRUE(SamePixels<Bgr>(image, SmallPicture(take, 0, first + frames).view())) << frames;
      ++frames;
    }
    return frames;
  }

  std::string ErrorOnOpening() const {
    try {
      VideoReader reader(file_);
    } catch (const SetupError& error) {
      return error.what();
    }
    return "none";
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "video.mkv";
  SmallTake take_;
};

TEST_F(Video, ReadingGivesBackWhatWasWritten) {
  WriteVideo();
  VideoReader reader(file_);
  EXPECT_EQ(reader.width_px(), take_.width_px);
  EXPECT_EQ(reader.height_px(), take_.height_px);
  EXPECT_EQ(CountAndCompare(reader, take_), kFrames);
}

TEST_F(Video, EveryCodecGivesTheSamePixelsBack) {
  for (const VideoCodec codec : {VideoCodec::kHuffYuv, VideoCodec::kFfv1, VideoCodec::kRaw}) {
    {
      VideoWriter writer(file_, take_.width_px, take_.height_px, 25, VideoPixels::kBgr, codec);
      for (int i = 0; i < kFrames; ++i) writer.Write(SmallPicture(take_, 0, i).view());
    }
    VideoReader reader(file_);
    EXPECT_EQ(CountAndCompare(reader, take_), kFrames) << static_cast<int>(codec);
  }
}

TEST_F(Video, WhatIsWrittenIsReadableAtOnceButForTheLastFrames) {
  for (const VideoCodec codec : {VideoCodec::kHuffYuv, VideoCodec::kFfv1, VideoCodec::kRaw}) {
    VideoWriter writer(file_, take_.width_px, take_.height_px, 25, VideoPixels::kBgr, codec);
    for (int i = 0; i < kFrames; ++i) writer.Write(SmallPicture(take_, 0, i).view());
    VideoReader reader(file_);
    EXPECT_GE(CountAndCompare(reader, take_), kFrames - 2) << static_cast<int>(codec);
  }
}

TEST_F(Video, MasksComeBackAsTheyWere) {
  Image<std::uint8_t> mask(take_.width_px, take_.height_px);
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) mask(x, y) = (x * 7 + y * 3) % 5 < 2 ? 255 : 0;
  }
  {
    VideoWriter writer(file_, take_.width_px, take_.height_px, 25, VideoPixels::kGray);
    writer.Write(mask.view());
  }
  VideoReader reader(file_);
  ImageView<const Bgr> image;
  ASSERT_EQ(reader.Read(image), VideoStatus::kFrame);
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      ASSERT_EQ(image(x, y), (Bgr{mask(x, y), mask(x, y), mask(x, y)}));
    }
  }
}

TEST_F(Video, SameFramesGiveTheSameBytes) {
  WriteVideo();
  const std::string once = testing::ReadText(file_);
  WriteVideo();
  EXPECT_EQ(testing::ReadText(file_), once);
}

TEST_F(Video, RewindingStartsOver) {
  WriteVideo();
  VideoReader reader(file_);
  ImageView<const Bgr> image;
  ASSERT_EQ(reader.Read(image), VideoStatus::kFrame);
  reader.Rewind();
  EXPECT_EQ(CountAndCompare(reader, take_), kFrames);
  reader.Rewind();
  EXPECT_EQ(CountAndCompare(reader, take_), kFrames);
}

TEST_F(Video, ReturnsToAnyFrameThatWasPassed) {
  for (const VideoCodec codec : {VideoCodec::kHuffYuv, VideoCodec::kFfv1, VideoCodec::kRaw}) {
    {
      VideoWriter writer(file_, take_.width_px, take_.height_px, 25, VideoPixels::kBgr, codec);
      for (int i = 0; i < kFrames; ++i) writer.Write(SmallPicture(take_, 0, i).view());
    }
    VideoReader reader(file_);
    EXPECT_FALSE(reader.ReturnTo(1)) << "not seen yet";
    reader.Rewind();
    while (reader.Skip() != VideoStatus::kEnd) {
    }
    for (int frame = kFrames - 1; frame >= 0; --frame) {
      ASSERT_TRUE(reader.ReturnTo(static_cast<std::size_t>(frame))) << frame;
      EXPECT_EQ(CountAndCompare(reader, take_, frame), kFrames - frame) << frame;
    }
  }
}

TEST_F(Video, ReturnsToFramesThatNeedOthers) {
  testing::WriteVideoOfDependentFrames(file_, 64, 48, kFrames);
  VideoReader reader(file_);
  ImageView<const Bgr> image;
  while (reader.Read(image) != VideoStatus::kEnd) {
  }
  for (int frame = kFrames - 1; frame >= 0; --frame) {
    ASSERT_TRUE(reader.ReturnTo(static_cast<std::size_t>(frame))) << frame;
    ASSERT_EQ(reader.Read(image), VideoStatus::kFrame) << frame;
    for (int x = 0; x < 64; ++x) ASSERT_EQ(image(x, 20).g, testing::NoiseAt(frame, x, 20));
  }
}

TEST_F(Video, ReturnsBesideADamagedFrame) {
  testing::WriteVideoWithSpoiledFrame(file_, take_, 4);
  VideoReader reader(file_);
  ImageView<const Bgr> image;
  for (int i = 0; i < 8; ++i) std::ignore = reader.Read(image);
  ASSERT_TRUE(reader.ReturnTo(6));
  ASSERT_EQ(reader.Read(image), VideoStatus::kFrame);
  EXPECT_EQ(image(0, 0).g, testing::GrayOf(6));
}

TEST_F(Video, KeptInMemoryItNeedsNoFile) {
  WriteVideo();
  VideoReader reader(file_);
  reader.KeepInMemory();
  std::filesystem::remove(file_);
  EXPECT_EQ(CountAndCompare(reader, take_), kFrames);
  reader.Rewind();
  EXPECT_EQ(reader.Skip(), VideoStatus::kFrame);
  EXPECT_EQ(CountAndCompare(reader, take_, 1), kFrames - 1);
  EXPECT_EQ(reader.Skip(), VideoStatus::kEnd);
}

TEST_F(Video, SkippingPassesOverOneFrame) {
  WriteVideo();
  VideoReader reader(file_);
  EXPECT_EQ(reader.Skip(), VideoStatus::kFrame);
  EXPECT_EQ(reader.Skip(), VideoStatus::kFrame);
  EXPECT_EQ(CountAndCompare(reader, take_, 2), kFrames - 2);
  EXPECT_EQ(reader.Skip(), VideoStatus::kEnd);
}

TEST_F(Video, SkippedFramesAreNotDecoded) {
  testing::WriteVideoWithSpoiledFrame(file_, take_, 4);
  VideoReader reader(file_);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(reader.Skip(), VideoStatus::kFrame) << i;
  ImageView<const Bgr> image;
  ASSERT_EQ(reader.Read(image), VideoStatus::kFrame);
  EXPECT_EQ(image(0, 0).g, testing::GrayOf(8));
}

TEST_F(Video, SkippedFramesAreDecodedWhenLaterOnesNeedThem) {
  testing::WriteVideoOfDependentFrames(file_, 64, 48, kFrames);
  for (int skipped = 0; skipped < kFrames; ++skipped) {
    VideoReader reader(file_);
    for (int i = 0; i < skipped; ++i) EXPECT_EQ(reader.Skip(), VideoStatus::kFrame);
    ImageView<const Bgr> image;
    ASSERT_EQ(reader.Read(image), VideoStatus::kFrame) << skipped;
    for (int x = 0; x < 64; ++x) ASSERT_EQ(image(x, 20).g, testing::NoiseAt(skipped, x, 20));
  }
}

TEST_F(Video, CutOffFileEndsWithItsLastWholeFrame) {
  WriteVideo();
  CutFile(file_, 0.6);
  VideoReader reader(file_);
  const int frames = CountAndCompare(reader, take_);
  EXPECT_GE(frames, kFrames / 2 - 1);
  EXPECT_LT(frames, kFrames);
  EXPECT_EQ(reader.Skip(), VideoStatus::kEnd);
}

TEST_F(Video, EveryLengthOfACutFileIsReadOrRefused) {
  WriteVideo();
  const std::string whole = testing::ReadText(file_);
  int before = 0;
  for (std::size_t length = 0; length < whole.size(); length += whole.size() / 37) {
    testing::WriteText(file_, whole.substr(0, length));
    int frames = 0;
    try {
      VideoReader reader(file_);
      frames = CountAndCompare(reader, take_);
    } catch (const SetupError&) {
    }
    EXPECT_GE(frames, before) << length;
    before = frames;
  }
  EXPECT_GE(before, kFrames - 2);
}

TEST_F(Video, DamagedFrameIsCalledBrokenAndReadingGoesOn) {
  testing::WriteVideoWithSpoiledFrame(file_, take_, 4);
  VideoReader reader(file_);
  ImageView<const Bgr> image;
  for (int i = 0; i < take_.frames; ++i) {
    const VideoStatus status = reader.Read(image);
    ASSERT_EQ(status, i == 4 ? VideoStatus::kBroken : VideoStatus::kFrame) << i;
    if (status == VideoStatus::kBroken) continue;
    EXPECT_EQ(image(0, 0).g, testing::GrayOf(i));
  }
  EXPECT_EQ(reader.Read(image), VideoStatus::kEnd);
}

TEST_F(Video, MissingFileIsNamed) {
  EXPECT_THAT(ErrorOnOpening(), AllOf(HasSubstr(file_.string()), HasSubstr("not found")));
}

TEST_F(Video, AnEmptyFileIsToldAsEmpty) {
  testing::WriteText(file_, "");
  EXPECT_THAT(ErrorOnOpening(), AllOf(HasSubstr(file_.string()), HasSubstr("is empty")));
}

TEST_F(Video, TextIsNoVideo) {
  for (const char* text : {"no video\n", "ffconcat version 1.0\nfile other.mkv\n", "#EXTM3U\n"}) {
    testing::WriteText(file_, text);
    EXPECT_THAT(ErrorOnOpening(), AllOf(HasSubstr(file_.string()), HasSubstr("no"))) << text;
  }
}

TEST_F(Video, UnwritablePlaceIsNamed) {
  const auto file = folder_.path() / "absent" / "video.mkv";
  EXPECT_THROW(VideoWriter(file, 64, 48, 25, VideoPixels::kBgr), SetupError);
}

}  // namespace
}  // namespace mocap
