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

TEST_F(TakeTableFile, PassesOverALastLineThatWasCutOff) {
  EXPECT_EQ(Read("frame,timestamp_ns\n0,100\n1,20").rows.size(), 1u);
}

struct DamagedTable {
  const char* text;
  int line;
  const char* says;
};

TEST_F(TakeTableFile, DamageIsNamedWithFileAndLine) {
  const DamagedTable cases[] = {
      {"", 1, "header"},
      {"frame,timestamp_ns", 1, "header"},
      {"frame;timestamp_ns\n0,1\n", 1, "header"},
      {"timestamp_ns,frame\n0,1\n", 1, "header"},
      {"frame,timestamp_ns\n", 1, "no rows"},
      {"frame,timestamp_ns\n0,1\nx,2\n", 3, "\"x\""},
      {"frame,timestamp_ns\n0,1\n1,two\n", 3, "\"two\""},
      {"frame,timestamp_ns\n0,1\n1,2\r3\xff\n", 3, "\"2?3?\""},
      {"frame,timestamp_ns\n0,1\n1,2.5\n", 3, "\"2.5\""},
      {"frame,timestamp_ns\n0,1\n1, 2\n", 3, "\" 2\""},
      {"frame,timestamp_ns\n0,1\n1,\n", 3, "timestamp_ns"},
      {"frame,timestamp_ns\n0,1\n\n", 3, "fields"},
      {"frame,timestamp_ns\n0,1,0.5,0.5\n", 2, "4 fields"},
      {"frame,timestamp_ns,pan_rad,tilt_rad\n0,1\n", 2, "2 fields"},
      {"frame,timestamp_ns,pan_rad,tilt_rad\n0,1,nan,0\n", 2, "finite"},
      {"frame,timestamp_ns,pan_rad,tilt_rad\n0,1,0,left\n", 2, "\"left\""},
      {"frame,timestamp_ns\n-1,1\n", 2, "frame"},
      {"frame,timestamp_ns\n0,-1\n", 2, "timestamp_ns"},
      {"frame,timestamp_ns\n0,99999999999999999999\n", 2, "timestamp_ns"},
      {"frame,timestamp_ns\n0,9000000000000000000\n", 2, "timestamp_ns"},
      {"frame,timestamp_ns\n0,5\n1,5\n", 3, "times must increase"},
      {"frame,timestamp_ns\n0,5\n1,4\n", 3, "times must increase"},
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
  EXPECT_FALSE(holds_none("")) << "is no table";
  EXPECT_FALSE(HoldsNoRows(folder_.path() / "absent.csv"));
}

TEST_F(TakeTableFile, MissingFileIsNamed) {
  EXPECT_THROW(ReadTakeTable(folder_.path() / "absent.csv"), SetupError);
  EXPECT_THROW(ReadTakeTable(folder_.path()), SetupError);
}

}  // namespace
}  // namespace mocap
