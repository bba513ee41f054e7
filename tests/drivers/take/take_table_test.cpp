#include "drivers/take/take_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class TakeTableFile : public ::testing::Test {
 protected:
  TakeTable Read(const std::string& text) {
    testing::WriteText(file_, text);
    return ReadTakeTable(file_);
  }

  std::string Error(const std::string& text) {
    try {
      Read(text);
    } catch (const SetupError& error) {
      return error.what();
    }
    return "none";
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "cam1.csv";
};

TEST_F(TakeTableFile, GivesFramesAndTimes) {
  const TakeTable table = Read("frame,timestamp_ns\n0,999999883739\n2,1000033192371\n");
  EXPECT_FALSE(table.has_angles);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[1].frame, 2u);
  EXPECT_EQ(table.rows[1].timestamp_ns, 1000033192371);
}

TEST_F(TakeTableFile, GivesAngles) {
  const TakeTable table = Read("frame,timestamp_ns,pan_rad,tilt_rad\r\n7,5,0.25,-1e-3\r\n");
  EXPECT_TRUE(table.has_angles);
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0].angles, (PanTiltAngles{0.25, -1e-3}));
}

TEST_F(TakeTableFile, PassesOverALastLineThatWasCutOffAndSaysSo) {
  const char* cut_off[] = {"frame,timestamp_ns\n0,100\n1,20", "frame,timestamp_ns\n0,100\n1,",
                           "frame,timestamp_ns\n0,100\n1"};
  for (const char* text : cut_off) {
    const TakeTable table = Read(text);
    EXPECT_EQ(table.rows.size(), 1u) << text;
    EXPECT_TRUE(table.is_cut_off) << text;
  }
  // Digits are missing, though the time increases.
  EXPECT_EQ(Read("frame,timestamp_ns\n0,0\n1,9000\n2,18000\n3,18001").rows.size(), 3u);
  const TakeTable turned =
      Read("frame,timestamp_ns,pan_rad,tilt_rad\n0,100,0,1e-5\n1,200,0,2e-5\n2,300,0,3");
  EXPECT_EQ(turned.rows.size(), 2u);
  EXPECT_TRUE(turned.is_cut_off);
}

TEST_F(TakeTableFile, LosesNoFrameWhoseLineHasNoEnd) {
  const TakeTable table = Read("frame,timestamp_ns\n0,100\n1,200\n2,300");
  EXPECT_EQ(table.rows.size(), 3u);
  EXPECT_FALSE(table.is_cut_off);
  EXPECT_FALSE(Read("frame,timestamp_ns\n0,100\n").is_cut_off);
}

TEST_F(TakeTableFile, IsReadHoweverAnEditorSavedIt) {
  const char* saved[] = {
      "\xef\xbb\xbf"
      "frame,timestamp_ns\n0,100\n1,200\n",
      "frame,timestamp_ns\r\n0,100\r\n1,200\r\n", "frame,timestamp_ns\r0,100\r1,200\r",
      "frame,timestamp_ns\r\r\n0,100\r\r\n1,200\r\r\n",
      "\xef\xbb\xbf"
      "frame,timestamp_ns\r\n0,100\r\n1,200\r\n\r\n,\r\n"};
  for (const char* text : saved) {
    const TakeTable table = Read(text);
    ASSERT_EQ(table.rows.size(), 2u) << text;
    EXPECT_EQ(table.rows[1].timestamp_ns, 200) << text;
  }
}

TEST_F(TakeTableFile, IsReadWhereverABufferEnds) {
  std::string text = "frame,timestamp_ns\r\n";
  constexpr int kRows = 20'000;
  for (int i = 0; i < kRows; ++i) text += std::to_string(i) + ',' + std::to_string(i + 1) + "\r\n";
  EXPECT_EQ(Read(text).rows.size(), std::size_t{kRows});
}

TEST_F(TakeTableFile, TellsHowFarFramesLieApart) {
  EXPECT_EQ(UsualIntervalNs(Read("frame,timestamp_ns\n0,100\n1,150\n9,600\n10,650\n")), 50);
  EXPECT_EQ(UsualIntervalNs(Read("frame,timestamp_ns\n0,100\n")), 0);
}

struct DamagedTable {
  const char* text;
  int line;
  const char* says;
};

TEST_F(TakeTableFile, DamageIsNamedWithFileAndLine) {
  const DamagedTable cases[] = {
      {"", 1, "is empty"},
      {"frame,timestamp_ns", 1, "header"},
      {"frame;timestamp_ns\n0;1\n", 1, "semicolons"},
      {"frame\ttimestamp_ns\n0\t1\n", 1, "tabs"},
      {"\"frame\",\"timestamp_ns\"\n0,1\n", 1, "quotation marks"},
      {"\xff\xfe"
       "f",
       1, "UTF-16"},
      {"frame,timestamp_ns\n0,1.76399E+18\n", 2, "spreadsheet"},
      {"frame,timestamp_ns\n0\n1,2\n", 2, "has 1 field;"},
      {"frame,timestamp_ns\n-0x,2\n", 2, "\"-0x\""},
      {"timestamp_ns,frame\n0,1\n", 1, "header"},
      {"frame,timestamp_ns\n", 1, "no rows"},
      {"frame,timestamp_ns\n0,1\nx,2\n", 3, "\"x\""},
      {"frame,timestamp_ns\n0,1\n1,two\n", 3, "\"two\""},
      {"frame,timestamp_ns\n0,1\n1,2\x1b[0m3\xff\n", 3, "\"2\\x1b[0m3\\xff\""},
      {"frame,timestamp_ns\n0,1\n1,2.5\n", 3, "\"2.5\""},
      {"frame,timestamp_ns\n0,1\n1, 2\n", 3, "\" 2\""},
      {"frame,timestamp_ns\n0,1\n1,\n", 3, "timestamp_ns"},
      {"frame,timestamp_ns\n0,1\n\n2,3\n", 3, "is empty"},
      {"frame,timestamp_ns\n0,1,0.5,0.5\n", 2, "4 fields"},
      {"frame,timestamp_ns,pan_rad,tilt_rad\n0,1\n", 2, "2 fields"},
      {"frame,timestamp_ns,pan_rad,tilt_rad\n0,1,nan,0\n", 2, "pan_rad is \"nan\""},
      {"frame,timestamp_ns,pan_rad,tilt_rad\n0,1,0,left\n", 2, "\"left\""},
      {"frame,timestamp_ns\n-1,1\n", 2, "frame"},
      {"frame,timestamp_ns\n0,-1\n", 2, "timestamp_ns"},
      {"frame,timestamp_ns\n0,99999999999999999999\n", 2, "timestamp_ns"},
      {"frame,timestamp_ns\n0,9000000000000000000\n", 2, "timestamp_ns"},
      {"frame,timestamp_ns\n0,5\n1,5\n", 3, "nanoseconds that increase"},
      {"frame,timestamp_ns\n0,5\n1,4\n", 3, "nanoseconds that increase"},
      {"frame,timestamp_ns\n3,5\n3,6\n", 3, "numbers must increase"},
      {"frame,timestamp_ns\n0,0\n1,700000000000000\n", 3, "week"},
  };
  for (const DamagedTable& damaged : cases) {
    const std::string where = file_.string() + ":" + std::to_string(damaged.line) + ": ";
    EXPECT_THAT(Error(damaged.text),
                AllOf(HasSubstr(where), HasSubstr(damaged.says), Not(HasSubstr("\n"))))
        << damaged.text;
  }
}

TEST_F(TakeTableFile, OfACameraThatDeliveredNothingHoldsNoRows) {
  const auto holds_none = [this](const std::string& text) {
    testing::WriteText(file_, text);
    return HoldsNoRows(file_);
  };
  EXPECT_TRUE(holds_none("frame,timestamp_ns\n"));
  EXPECT_TRUE(holds_none("frame,timestamp_ns,pan_rad,tilt_rad\n0,1"));
  EXPECT_FALSE(holds_none("frame,timestamp_ns\n0,1\n"));
  EXPECT_FALSE(holds_none("frame,timestamp_ns\n0,1")) << "a row, though its line has no end";
  EXPECT_FALSE(holds_none("")) << "is no table";
  EXPECT_FALSE(HoldsNoRows(folder_.path() / "absent.csv"));
}

TEST_F(TakeTableFile, WhatIsNoTextIsOneShortLine) {
  const std::string binary("frame,timestamp_ns\n0,\0\0\n", 24);
  EXPECT_THAT(Error(binary), HasSubstr(":2: contains a zero byte"));
  const std::string long_line = Error("frame,timestamp_ns\n" + std::string(3 << 20, '7') + "\n");
  EXPECT_THAT(long_line, HasSubstr(":2: is longer than"));
  EXPECT_LT(Error(std::string(500'000, 'x')).size(), 250u);
}

TEST_F(TakeTableFile, MissingFileIsNamed) {
  EXPECT_THROW(ReadTakeTable(folder_.path() / "absent.csv"), SetupError);
  EXPECT_THROW(ReadTakeTable(folder_.path()), SetupError);
}

}  // namespace
}  // namespace mocap
