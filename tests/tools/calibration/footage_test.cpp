#include "tools/calibration/footage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <string_view>

#include "core/errors.h"
#include "drivers/take/video_writer.h"
#include "tests/support/telephone_video.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using testing::TemporaryFolder;
using testing::WriteText;

class FootageTest : public ::testing::Test {
 protected:
  // A portable pixmap of 16 x 16; FFmpeg needs no more than its name to end in .bmp or .png to be
  // asked for it, and looks at what it holds.
  void WritePicture(const std::string& name) {
    fs::create_directories((folder_.path() / name).parent_path());
    std::ofstream out(folder_.path() / name, std::ios::binary);
    const auto number = [&out](auto value) {
      out.write(reinterpret_cast<const char*>(&value), sizeof value);
    };
    constexpr std::int32_t kSide = 16;
    out << "BM";
    for (const std::int32_t n : {54 + 3 * kSide * kSide, 0, 54, 40, kSide, kSide}) number(n);
    for (const std::int16_t n : {1, 24}) number(n);
    for (const std::int32_t n : {0, 3 * kSide * kSide, 0, 0, 0, 0}) number(n);
    out << std::string(3 * kSide * kSide, 'x');
  }
  void WriteVideo(const std::string& name, int frames) {
    VideoWriter writer(folder_.path() / name, 16, 16, 10, VideoPixels::kBgr);
    const Image<Bgr> picture(16, 16);
    for (int i = 0; i < frames; ++i) writer.Write(picture.view());
    writer.Finish();
  }
  // "img1+img1 -+img2": which pictures belong to one moment, camera by camera.
  std::string Moments(const Footage& footage) {
    std::string text;
    for (const FootageMoment& moment : MatchMoments(footage)) {
      for (std::size_t c = 0; c < moment.frames.size(); ++c) {
        const int frame = moment.frames[c];
        text += (c == 0 ? (text.empty() ? "" : " ") : "+") +
                (frame < 0 ? "-" : fs::path(footage.cameras[c].frames[frame].name).stem().string());
      }
    }
    return text;
  }
  std::string Why() {
    try {
      OpenFootage(folder_.path());
    } catch (const SetupError& error) {
      return error.what();
    }
    return "accepted";
  }

  TemporaryFolder folder_;
};

TEST_F(FootageTest, PicturesOfAMomentAreThoseOfOneNumber) {
  for (const char* name :
       {"cam1/img1.bmp", "cam1/img2.bmp", "cam1/img10.bmp", "cam2/img01.bmp", "cam2/img10.bmp"})
    WritePicture(name);
  const Footage footage = OpenFootage(folder_.path());
  EXPECT_EQ(Moments(footage), "img1+img01 img2+- img10+img10");
  EXPECT_THAT(footage.notes, ElementsAre(AllOf(HasSubstr("cam2"), HasSubstr("img2.bmp"))));
}

TEST_F(FootageTest, NumbersAreTakenFromWhereTheyCount) {
  EXPECT_THAT(PictureKeys({"cam2_009.png", "cam2_10.png"}), ElementsAre("9", "10"));
  EXPECT_THAT(PictureKeys({"0003_cam2.png", "0012_cam2.png"}), ElementsAre("3", "12"));
  EXPECT_THAT(PictureKeys({"left.png", "right.png"}), ElementsAre("left.png", "right.png"));
  EXPECT_THAT(PictureKeys({"1.png", "01.png"}), ElementsAre("1.png", "01.png"));
  EXPECT_THAT(PictureKeys({"20261125093000123456789.png"}), ElementsAre("20261125093000123456789"));
  EXPECT_TRUE(IsKeyLess("9", "10"));
  EXPECT_FALSE(IsKeyLess("10", "9"));
}

TEST_F(FootageTest, CamerasThatCountEachForThemselvesArePairedInOrderAndThatIsTold) {
  for (const char* name :
       {"cam1/DSC_7.bmp", "cam1/DSC_8.bmp", "cam2/DSC_99.bmp", "cam2/DSC_100.bmp"})
    WritePicture(name);
  const Footage footage = OpenFootage(folder_.path());
  EXPECT_EQ(Moments(footage), "DSC_7+DSC_99 DSC_8+DSC_100");
  EXPECT_THAT(footage.notes, Contains(HasSubstr("no numbers in common")));
  WritePicture("cam2/DSC_101.bmp");
  const Footage more = OpenFootage(folder_.path());
  EXPECT_EQ(Moments(more), "DSC_7+- DSC_8+- -+DSC_99 -+DSC_100 -+DSC_101");
  EXPECT_THAT(more.notes, Contains(HasSubstr("cannot be paired")));
}

// 16 x 16, red: without loss, and with.
constexpr std::string_view kLosslessWebP(
    "RIFF\x1c\0\0\0WEBPVP8L\x0f\0\0\0\x2f\x0f\xc0\x03\0\x07\x10\xf5\x8f\xfe\x07\x22\xa2\xff\x01\0",
    36);
constexpr std::string_view kLossyWebP(
    "RIFF\x3c\0\0\0WEBPVP8 "
    "\x30\0\0\0\xd0\x01\0\x9d\x01\x2a\x10\0\x10\0\x02\0\x34\x25\xa0\x02\x74\xba\x01"
    "\xf8\0\x03\xb0\0\xfe\xf0\xe8\xf7\xff\x20\xb9\x61\x75\xc8\xd7\xff\x20\x3f\xe4\x07\xfc\x80\xff"
    "\xf8\xf2\0"
    "\0\0",
    68);

TEST_F(FootageTest, PicturesInWebPAreRead) {
  fs::create_directories(folder_.path() / "cam1");
  WriteText(folder_.path() / "cam1/img1.webp", std::string(kLosslessWebP));
  WriteText(folder_.path() / "cam1/img2.WEBP", std::string(kLossyWebP));
  const Footage footage = OpenFootage(folder_.path());
  ASSERT_THAT(footage.cameras, SizeIs(1));
  EXPECT_EQ(footage.cameras[0].width_px, 16);
  int red = 0;
  footage.cameras[0].ForEach([&](int, ImageView<const Bgr> view) {
    red += view(8, 8).r > 240 && view(8, 8).g < 20 && view(8, 8).b < 20;
  });
  EXPECT_EQ(red, 2);
}

TEST_F(FootageTest, PicturesOfKindsThatAreNotReadAreRefusedByTheirKind) {
  WritePicture("cam1/img1.bmp");
  for (const auto& [name, kind] : {std::pair("cam2/IMG_0001.HEIC", "HEIC pictures are not read"),
                                   std::pair("cam2/img1.avif", "AVIF pictures are not read"),
                                   std::pair("cam2/DSC_1.NEF", "Raw pictures are not read")}) {
    fs::create_directories(folder_.path() / "cam2");
    WriteText(folder_.path() / name, "x");
    EXPECT_THAT(Why(), AllOf(HasSubstr(name), HasSubstr(kind), HasSubstr("convert them to JPEG")));
    fs::remove_all(folder_.path() / "cam2");
  }
}

TEST_F(FootageTest, PicturesThatNobodyWouldReadMayLieBesideVideos) {
  for (const char* name : {"cam1", "notes", "setup photos"})
    fs::create_directories(folder_.path() / name);
  WriteVideo("cam1/take.mkv", 2);
  for (const char* name : {"cam1/IMG_1.HEIC", "notes/IMG_2.HEIC", "setup photos/IMG_3.HEIC"})
    WriteText(folder_.path() / name, "x");
  EXPECT_THAT(OpenFootage(folder_.path()).cameras, SizeIs(1));
}

TEST_F(FootageTest, APictureOfAKindThatIsNotReadMayLieBesideOneThatIs) {
  WritePicture("cam1/DSC_1.bmp");
  WriteText(folder_.path() / "cam1/DSC_1.NEF", "x");
  EXPECT_THAT(OpenFootage(folder_.path()).cameras, SizeIs(1));
}

TEST_F(FootageTest, APictureWhoseNameDoesNotTellItsKindIsRefusedByWhatItIs) {
  fs::create_directories(folder_.path() / "cam1");
  WriteText(folder_.path() / "cam1/img1.jpg", std::string("\0\0\0\x18"
                                                          "ftypheic\0\0\0\0mif1heic",
                                                          24));
  EXPECT_THAT(Why(), AllOf(HasSubstr("img1.jpg"), HasSubstr("HEIC pictures are not read")));
  fs::remove(folder_.path() / "cam1/img1.jpg");
  WriteText(folder_.path() / "cam1/img1.webp",
            std::string("RIFF\x16\0\0\0WEBPVP8X\x0a\0\0\0\x02\0\0\0\x0f\0\0\x0f\0\0", 30));
  EXPECT_THAT(Why(),
              AllOf(HasSubstr("img1.webp"), HasSubstr("Animated WebP pictures are not read")));
}

TEST_F(FootageTest, WhereThereIsNoRecordingTheFilesThatThereAreAreNamed) {
  fs::create_directories(folder_.path() / "cam1");
  WriteText(folder_.path() / "cam1/take.mts", "x");
  WriteText(folder_.path() / "cam1/more.mts", "x");
  WriteText(folder_.path() / "readme", "x");
  EXPECT_THAT(Why(), AllOf(HasSubstr("contains no recording"), HasSubstr("2 files .mts"),
                           HasSubstr("1 file without an extension"), HasSubstr("JPEG")));
}

TEST_F(FootageTest, HiddenFilesOfOtherSystemsArePassedOver) {
  WritePicture("cam1/img1.bmp");
  WriteText(folder_.path() / "cam1/._img1.bmp", "x");
  WriteText(folder_.path() / "cam1/Thumbs.db", "x");
  WriteText(folder_.path() / ".DS_Store", "x");
  fs::create_directories(folder_.path() / ".Trashes");
  WritePicture(".Trashes/img1.bmp");
  const Footage footage = OpenFootage(folder_.path());
  ASSERT_THAT(footage.cameras, SizeIs(1));
  EXPECT_THAT(footage.cameras[0].frames, SizeIs(1));
  WriteVideo("cam2.mkv", 2);
  WriteText(folder_.path() / "._cam2.mkv", "x");
  EXPECT_THAT(OpenFootage(folder_.path()).cameras, SizeIs(1));
}

TEST_F(FootageTest, CaliscopesTablesTellTimes) {
  WriteVideo("cam_0.mkv", 3);
  WriteVideo("cam_1.mkv", 3);
  const fs::path table = folder_.path() / "timestamps.csv";
  for (const char* text :
       {"cam_id,frame_time\n0,9.1\n1,9.1\n0,9.2\n1,9.2\n0,9.4\n1,9.4\n",
        "\xEF\xBB\xBF"
        "cam_id,frame_time\r\n0,9.1\r\n1,9.1\r\n0,9.2\r\n1,9.2\r\n0,9.4\r\n1,9.4",
        "port,frame_index,frame_time\n0,0,9.1\n1,0,9.1\n0,2,9.4\n0,1,9.2\n1,1,9.2\n1,2,9.4\n",
        "sync_index,cam_id,frame_index,frame_time\n0,0,0,9.1\n0,1,0,9.1\n1,0,1,9.2\n1,1,1,9.2\n2,"
        "0,2,9.4\n2,1,2,9.4\n"}) {
    WriteText(table, text);
    const Footage footage = OpenFootage(folder_.path());
    ASSERT_THAT(footage.cameras, SizeIs(2)) << text;
    EXPECT_TRUE(footage.cameras[1].timed);
    EXPECT_EQ(footage.cameras[1].frames[2].time_ns, 9'400'000'000) << text;
  }
}

TEST_F(FootageTest, ATableOfTimesThatIsWrongIsRefusedByItsLine) {
  WriteVideo("cam_0.mkv", 2);
  const fs::path table = folder_.path() / "timestamps.csv";
  const auto why = [&](const std::string& text) {
    WriteText(table, text);
    return Why();
  };
  EXPECT_THAT(why("frame,time\n"), AllOf(HasSubstr("timestamps.csv:1"), HasSubstr("cam_id")));
  EXPECT_THAT(why(""), HasSubstr("timestamps.csv:1"));
  EXPECT_THAT(why("cam_id,frame_time\n0,nan\n0,2\n"), HasSubstr("timestamps.csv:2"));
  EXPECT_THAT(why("cam_id,frame_time\n0,1\n0,1e300\n"), HasSubstr("timestamps.csv:3"));
  EXPECT_THAT(why("cam_id,frame_time\n0,2\n0,1\n"), HasSubstr("timestamps.csv:3"));
  EXPECT_THAT(why("cam_id,frame_time\n0,1,2\n"), HasSubstr("timestamps.csv:2"));
  EXPECT_THAT(why("cam_id,frame_time\nx,1\n"), HasSubstr("timestamps.csv:2"));
  EXPECT_THAT(why("cam_id,frame_time\n0,1\n0,2\n0,3\n"), AllOf(HasSubstr("3"), HasSubstr("cam_0")));
}

TEST_F(FootageTest, VideosOfTelephonesArePairedByTheirOwnTimesAndThatIsTold) {
  testing::WriteTelephoneVideo(folder_.path() / "cam1.mov", {0, 33, 66, 100, 133},
                               testing::kHeldUpright);
  // One that dropped the second frame and the third.
  testing::WriteTelephoneVideo(folder_.path() / "cam2.mov", {0, 99, 135}, testing::kHeldUpright);
  const Footage footage = OpenFootage(folder_.path());
  EXPECT_EQ(Moments(footage),
            "frame 0+frame 0 frame 1+- frame 2+- frame 3+frame 1 frame 4+frame 2");
  EXPECT_EQ(footage.cameras[0].width_px, 32);
  EXPECT_THAT(footage.notes,
              AllOf(Contains(HasSubstr("cam2.mov: turned right by 90 degrees")),
                    Contains(AllOf(HasSubstr("cam2.mov"), HasSubstr("36 to 99 ms")))));
}

TEST_F(FootageTest, VideosWithoutSuchTimesSayNothing) {
  WriteVideo("cam1.mkv", 3);
  WriteVideo("cam2.mkv", 3);
  const Footage footage = OpenFootage(folder_.path());
  EXPECT_EQ(Moments(footage), "frame 0+frame 0 frame 1+frame 1 frame 2+frame 2");
  EXPECT_THAT(footage.notes, IsEmpty());
}

}  // namespace
}  // namespace mocap
