#include "tools/results/take_truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "core/errors.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class TakeTruthTest : public ::testing::Test {
 protected:
  TakeTruthTest() {
    Write("truth.toml",
          "stature_mm = 1750.0\nankle_to_sole_mm = 80.0\n\n[lengths]\ntorso_mm = 560.5\n");
  }

  void Write(const std::string& name, const std::string& text) const {
    testing::WriteText(take_ / name, text);
  }

  std::string ErrorOfReading() const {
    try {
      ReadTakeTruth(take_);
    } catch (const SetupError& error) {
      return error.what();
    }
    return "no error";
  }

  static std::string Header() {
    std::ostringstream line("frame,timestamp_ns", std::ios::ate);
    for (const char* joint :
         {"head", "neck", "shoulder_l", "shoulder_r", "elbow_l", "elbow_r", "fingertips_l",
          "fingertips_r", "hip_l", "hip_r", "knee_l", "knee_r", "ankle_l", "ankle_r"}) {
      for (const char* axis : {"x", "y", "z"}) line << ',' << joint << '_' << axis << "_mm";
    }
    line << '\n';
    return line.str();
  }

  /// Joint i lies at (i, 10 i, 1000); knees at 500 and ankles, under them, at 100 above the floor.
  /// @param first  the first cell after the time.
  static std::string Row(int frame, int time_ns, const std::string& first = "0") {
    std::ostringstream line;
    line << frame << ',' << time_ns << ',' << first << ",0,1000";
    for (int i = 1; i < 14; ++i) {
      const int column = i < 12 ? i : i - 2;
      line << ',' << column << ',' << 10 * column << ',' << (i < 10 ? 1000 : i < 12 ? 500 : 100);
    }
    line << '\n';
    return line.str();
  }

  const testing::TemporaryFolder folder_;
  const std::filesystem::path take_ = folder_.path();
};

TEST_F(TakeTruthTest, PutsTheFootOnTheSoleUnderTheAnkle) {
  Write("truth.csv", Header() + Row(0, 100) + Row(1, 200));
  const auto truth = ReadTakeTruth(take_);
  ASSERT_TRUE(truth);
  ASSERT_EQ(truth->frames.size(), 2u);
  EXPECT_EQ(truth->frames[1].timestamp_ns, 200);
  EXPECT_TRUE(truth->frames[0].points_W.col(5).isApprox(Vector3(5, 50, 1000)));
  EXPECT_TRUE(truth->frames[0].points_W.col(12).isApprox(Vector3(10, 100, 20)));
  EXPECT_EQ(truth->stature_mm, 1750);
  EXPECT_EQ(truth->lengths_mm.at("torso"), 560.5);
}

TEST_F(TakeTruthTest, ReadsWhatATableHasOfHandsFeetAndHead) {
  const auto widened = [](std::string line, const std::string& cells) {
    line.pop_back();
    return line + cells + '\n';
  };
  Write("truth.csv",
        widened(Header(),
                ",heel_r_x_mm,heel_r_y_mm,heel_r_z_mm,head_rotation_x_rad,head_rotation_y_rad,"
                "head_rotation_z_rad,contact_toe_l") +
            widened(Row(0, 100), ",1,2,3,0.1,0.2,0.3,1"));
  const auto truth = ReadTakeTruth(take_);
  ASSERT_TRUE(truth);
  ASSERT_EQ(truth->extremities.size(), 1u);
  const TrueExtremities& extremities = truth->extremities.front();
  EXPECT_EQ(FurtherOf(extremities.points_W, Point::kHeelR), Vector3(1, 2, 3));
  EXPECT_EQ(FurtherOf(extremities.points_W, Point::kAnkleL), Vector3(10, 100, 100));
  EXPECT_EQ(extremities.rotations.col(0), Vector3(0.1, 0.2, 0.3));
  EXPECT_EQ(extremities.contacts[2], 1);
  EXPECT_TRUE(std::isnan(extremities.contacts[0]));
  EXPECT_TRUE(extremities.rotations.rightCols<2>().array().isNaN().all());
}

TEST_F(TakeTruthTest, IsEmptyForATakeWithoutTruth) { EXPECT_FALSE(ReadTakeTruth(take_)); }

TEST_F(TakeTruthTest, FindsColumnsByName) {
  std::string header = Header();
  header.insert(header.find(",head_x_mm"), ",toe_x_mm");
  Write("truth.csv", header + Row(0, 100, "7,0"));
  EXPECT_TRUE(ReadTakeTruth(take_)->frames[0].points_W.col(0).isApprox(Vector3(0, 0, 1000)));
}

TEST_F(TakeTruthTest, NamesFileLineAndColumnOfWhatIsWrong) {
  const std::string csv = (take_ / "truth.csv").string();
  Write("truth.csv", "");
  EXPECT_THAT(ErrorOfReading(), StartsWith(csv + ":1: is empty"));
  Write("truth.csv", Header());
  EXPECT_THAT(ErrorOfReading(), StartsWith(csv + ": has no rows"));
  Write("truth.csv", "frame,timestamp_ns\n0,1\n");
  EXPECT_EQ(ErrorOfReading(), csv + ":1: has no column head_x_mm, separated by commas");
  Write("truth.csv", Header() + Row(0, 100) + Row(1, 100));
  EXPECT_THAT(ErrorOfReading(), StartsWith(csv + ":3: timestamp_ns 100 follows 100"));
  Write("truth.csv", Header() + Row(0, 100) + Row(1, 200, "word"));
  EXPECT_EQ(ErrorOfReading(), csv + ":3: head_x_mm is \"word\"; expected a number");
  Write("truth.csv", Header() + Row(0, 100) + Row(1, 200, "nan"));
  EXPECT_EQ(ErrorOfReading(), csv + ":3: head_x_mm is \"nan\"; expected a number");
  Write("truth.csv", Header() + "0,100\n");
  EXPECT_THAT(ErrorOfReading(), StartsWith(csv + ":2: has 2 fields; expected 44"));
}

TEST_F(TakeTruthTest, IsReadHoweverASpreadsheetSavedIt) {
  std::string saved = "\xef\xbb\xbf" + Header() + Row(0, 100) + Row(1, 200);
  for (std::size_t end = 0; (end = saved.find('\n', end)) != std::string::npos; end += 2) {
    saved.insert(end, "\r");
  }
  Write("truth.csv", saved + "\r\n");
  EXPECT_EQ(ReadTakeTruth(take_)->frames.size(), 2u);
  Write("truth.csv", saved.substr(0, saved.size() - 2));
  EXPECT_EQ(ReadTakeTruth(take_)->frames.size(), 2u) << "the last line has no end";
}

TEST_F(TakeTruthTest, WantsTheSizesBesideThePoints) {
  Write("truth.csv", Header() + Row(0, 100));
  std::filesystem::remove(take_ / "truth.toml");
  EXPECT_THAT(ErrorOfReading(), HasSubstr("truth.toml: not found"));
  Write("truth.toml", "stature_mm = 1750\n");
  EXPECT_THAT(ErrorOfReading(), HasSubstr("ankle_to_sole_mm is missing"));
  Write("truth.toml", "stature_mm = 1750\nankle_to_sole_mm = 80\n[lengths]\ntorso = 5\n");
  EXPECT_THAT(ErrorOfReading(), HasSubstr("truth.toml:4: lengths.torso has no unit"));
}

}  // namespace
}  // namespace mocap
