#include "tools/accuracy/score_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "drivers/take/text_file.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

PersonScore TwoRuns() {
  return {.firsts = {{PoseErrors{20.5, 61.25, 3.5}, 0.875}, {std::nullopt, 0}}, .sets = 9};
}

TEST(ScoreTable, ReadsWhatItWrites) {
  const testing::TemporaryFolder folder;
  const std::vector<ScoreRow> rows = RowsOf("takes", "takes-others", "a,\"b\"/person-1", TwoRuns());
  WriteText(folder.path() / "scores.csv", ScoreCsv(rows));
  const std::vector<ScoreRow> read = ReadScores(folder.path() / "scores.csv");
  ASSERT_EQ(read.size(), 2u);
  EXPECT_TRUE(read[0].Key() == rows[0].Key());
  EXPECT_EQ(read[1].first, 1);
  EXPECT_EQ(read[0].person, "a__b_/person-1");
  EXPECT_DOUBLE_EQ(read[0].errors->mean_mm, 20.5);
  EXPECT_DOUBLE_EQ(read[0].errors->p95_mm, 61.25);
  EXPECT_DOUBLE_EQ(read[0].errors->angle_deg, 3.5);
  EXPECT_DOUBLE_EQ(read[0].tracked_share, 0.875);
  EXPECT_FALSE(read[1].errors);
}

TEST(ScoreTable, TheSameRunTwiceIsRefusedWithItsLine) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "scores.csv";
  std::vector<ScoreRow> rows = RowsOf("variety", "30 Hz", "17", TwoRuns());
  rows.push_back(rows.front());
  WriteText(file, ScoreCsv(rows));
  EXPECT_THAT(testing::SetupErrorOf([&] { ReadScores(file); }),
              HasSubstr("scores.csv:4: variety, 30 Hz, 17, first set 0 is there twice"));
  WriteText(file, "frame,timestamp_ns\n");
  EXPECT_THAT(testing::SetupErrorOf([&] { ReadScores(file); }), HasSubstr("scores.csv"));
}

}  // namespace
}  // namespace mocap
