#include "drivers/take/picture_turn.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "drivers/take/video_reader.h"
#include "tests/support/telephone_video.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;
using testing::kHeldUpright;
using testing::TemporaryFolder;
using testing::WriteTelephoneVideo;

constexpr std::int32_t kOne = 65536;
constexpr std::array<std::int32_t, 9> kAsItIs = {kOne, 0, 0, 0, kOne, 0, 0, 0, 1 << 30};

// "abc / def", turned.
std::string Turned(const PictureTurn& turn) {
  Image<Bgr> in(3, 2), out(turn.SwapsSides() ? 2 : 3, turn.SwapsSides() ? 3 : 2);
  for (int i = 0; i < 6; ++i) in(i % 3, i / 3).b = static_cast<std::uint8_t>('a' + i);
  Turn(turn, std::as_const(in).view(), out.view());
  std::string text;
  for (int y = 0; y < out.height(); ++y) {
    if (y > 0) text += '/';
    for (int x = 0; x < out.width(); ++x) text += static_cast<char>(out(x, y).b);
  }
  return text;
}

TEST(PictureTurn, QuartersAndMirrorsGoWhereTheMatrixSays) {
  const auto turn = [](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    return *TurnFromDisplayMatrix({a * kOne, b * kOne, 0, c * kOne, d * kOne, 0, 0, 0, 1 << 30});
  };
  EXPECT_EQ(Turned(turn(1, 0, 0, 1)), "abc/def");
  EXPECT_EQ(Turned(turn(0, 1, -1, 0)), "da/eb/fc");
  EXPECT_EQ(Turned(turn(0, -1, 1, 0)), "cf/be/ad");
  EXPECT_EQ(Turned(turn(-1, 0, 0, -1)), "fed/cba");
  EXPECT_EQ(Turned(turn(-1, 0, 0, 1)), "cba/fed");
  EXPECT_EQ(turn(0, 1, -1, 0).Text(), "turned right by 90 degrees");
  EXPECT_EQ(turn(-1, 0, 0, 1).Text(), "mirrored");
}

TEST(PictureTurn, ATurnByOtherThanQuartersIsNone) {
  EXPECT_FALSE(TurnFromDisplayMatrix({46341, 46341, 0, -46341, 46341, 0, 0, 0, 1 << 30}));
  EXPECT_FALSE(TurnFromDisplayMatrix({2 * kOne, 0, 0, 0, 2 * kOne, 0, 0, 0, 1 << 30}));
  EXPECT_FALSE(TurnFromDisplayMatrix({kOne, kOne, 0, 0, kOne, 0, 0, 0, 1 << 30}));
  EXPECT_FALSE(TurnFromDisplayMatrix({}));
}

TEST(PictureTurn, AVideoIsReadAsItIsToBeShownAtTheTimesOfItsFrames) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "phone.mov";
  WriteTelephoneVideo(file, {0, 33, 80, 113}, kHeldUpright);
  VideoReader reader(file);
  EXPECT_EQ(reader.width_px(), 32);
  EXPECT_EQ(reader.height_px(), 64);
  EXPECT_EQ(reader.turn().Text(), "turned right by 90 degrees");
  ImageView<const Bgr> image;
  ASSERT_EQ(reader.Read(image), VideoStatus::kFrame);
  EXPECT_EQ(reader.time_ns(), 0);
  EXPECT_EQ(image(31, 0).g, 255) << "the top left corner is now the top right one";
  EXPECT_EQ(image(0, 0).g, 0);
  ASSERT_EQ(reader.Skip(), VideoStatus::kFrame);
  EXPECT_EQ(reader.time_ns(), 33'000'000);
  ASSERT_EQ(reader.Read(image), VideoStatus::kFrame);
  EXPECT_EQ(reader.time_ns(), 80'000'000);
}

TEST(PictureTurn, AVideoToBeShownAskewIsRefusedByName) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "askew.mov";
  WriteTelephoneVideo(file, {0, 33}, {46341, 46341, 0, -46341, 46341, 0, 0, 0, 1 << 30});
  std::string reason;
  try {
    const VideoReader reader(file);
  } catch (const SetupError& error) {
    reason = error.what();
  }
  EXPECT_THAT(reason, HasSubstr("askew.mov: has a display rotation"));
  WriteTelephoneVideo(file, {0, 33}, kAsItIs);
  EXPECT_TRUE(VideoReader(file).turn().IsNone());
}

TEST(PictureTurn, IsRestoredFromItsTag) {
  for (const char* degrees : {"0", "90", "180", "270"}) {
    const auto turn = TurnFromDegrees(degrees);
    ASSERT_TRUE(turn) << degrees;
    EXPECT_EQ(TurnInDegrees(*turn), degrees);
  }
  EXPECT_EQ(TurnFromDegrees("90")->Text(), "turned right by 90 degrees");
  EXPECT_EQ(TurnFromDegrees("-90"), TurnFromDegrees("270"));
  EXPECT_EQ(TurnFromDegrees("450"), TurnFromDegrees("90"));
  EXPECT_FALSE(TurnFromDegrees("45"));
  EXPECT_FALSE(TurnFromDegrees("90 degrees"));
  EXPECT_FALSE(TurnFromDegrees("99999999999999999999"));
  EXPECT_FALSE(TurnFromDegrees(""));
  EXPECT_FALSE(TurnInDegrees(PictureTurn{-1, 0, 0, 1}));
}

}  // namespace
}  // namespace mocap
