#include "tools/results/take_identity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "config/open_studio.h"
#include "tests/support/box_take.h"
#include "tests/support/run_command.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tools/evaluate.h"
#include "tools/export.h"
#include "tools/track.h"
#include "tools/view/take_site.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::kPeriodNs;
using testing::SetupErrorOf;

class TakeIdentityTest : public ::testing::Test {
 protected:
  TakeIdentityTest() {
    testing::WriteBoxTake(take_);
    testing::WriteBoxResult(result_);
  }

  /// Another take of the same studio, at the same times.
  std::filesystem::path OtherTake() const {
    std::filesystem::copy(take_, other_, std::filesystem::copy_options::recursive);
    testing::ReplaceInFile(other_ / "take.toml", "<box>", "other");
    return other_;
  }
  Result Read(const std::optional<TakeMark>& mark) const {
    Result result = ReadResult(result_);
    result.take = mark;
    return result;
  }
  std::vector<std::string> Remarks(Result result) const {
    TakeIdentity(take_).Require(result_, result);
    return result.remarks;
  }

  const testing::TemporaryFolder folder_;
  const std::filesystem::path take_ = folder_.path() / "take", other_ = folder_.path() / "other",
                              result_ = folder_.path() / "result";
};

TEST_F(TakeIdentityTest, AMarkIsKeptInTheResult) {
  const TakeMark mark = MarkOf(take_);
  EXPECT_EQ(mark.name, "<box>");
  WriteResult(result_, Read(mark));
  const Result read = ReadResult(result_);
  ASSERT_TRUE(read.take);
  EXPECT_EQ(read.take->name, mark.name);
  EXPECT_EQ(read.take->calibration, mark.calibration);
  EXPECT_THAT(Remarks(read), IsEmpty());
}

TEST_F(TakeIdentityTest, TheChecksumIsTheSameInEveryVersion) {
  testing::WriteText(take_ / "calibration.toml", "foobar");
  EXPECT_EQ(MarkOf(take_).calibration, "85944171f73967e8") << "the known FNV-1a of these bytes";
}

TEST_F(TakeIdentityTest, ACopyOfTheTakeIsTheTake) {
  WriteResult(result_, Read(MarkOf(take_)));
  std::filesystem::rename(take_, other_);
  Result result = ReadResult(result_);
  TakeIdentity(other_).Require(result_, result);
  EXPECT_THAT(result.remarks, IsEmpty());
}

TEST_F(TakeIdentityTest, NoCommandAcceptsAResultOfAnotherTake) {
  WriteResult(result_, Read(MarkOf(OtherTake())));
  const auto said = AllOf(HasSubstr(result_.string()), HasSubstr("\"other\""),
                          HasSubstr(take_.string()), HasSubstr("\"<box>\""));
  EXPECT_THAT(SetupErrorOf([&] {
                testing::RunCommand(AddEvaluateCommand,
                                    "evaluate " + take_.string() + ' ' + result_.string());
              }),
              said);
  EXPECT_THAT(SetupErrorOf([&] { TakeSite(take_, {result_}); }), said);
  std::filesystem::rename(result_, folder_.path() / "one");
  WritePeople(result_, {{2, ReadResult(folder_.path() / "one")}});
  EXPECT_THAT(SetupErrorOf([&] {
                testing::RunCommand(AddEvaluateCommand,
                                    "evaluate " + take_.string() + ' ' + result_.string());
              }),
              AllOf(said, HasSubstr("person-2")));
  EXPECT_THAT(SetupErrorOf([&] { TakeSite(take_, {result_}); }), said);
}

TEST_F(TakeIdentityTest, AnotherCalibrationIsTold) {
  const Result tracked_before = Read(MarkOf(take_));
  testing::ReplaceInFile(take_ / "calibration.toml", "matrix = [[400", "matrix = [[401");
  EXPECT_THAT(Remarks(tracked_before), ElementsAre(HasSubstr("another calibration")));
  WriteResult(result_, tracked_before);
  EXPECT_THAT(TakeSite(take_, {result_}).remarks(), ElementsAre(HasSubstr("another calibration")));
}

TEST_F(TakeIdentityTest, WithoutAMarkTimesAreCompared) {
  EXPECT_THAT(Remarks(Read({})), IsEmpty());
  Result later = Read({});
  for (PoseRow& row : later.poses) row.timestamp_ns += testing::kFrames / 2 * kPeriodNs;
  EXPECT_THAT(Remarks(later), ElementsAre(HasSubstr("; check that it is of this take")));
  for (PoseRow& row : later.poses) row.timestamp_ns += testing::kFrames * kPeriodNs;
  EXPECT_THAT(SetupErrorOf([&] { Remarks(later); }),
              AllOf(HasSubstr("the frames of"), HasSubstr("expected a result of that take")));
}

TEST_F(TakeIdentityTest, WithoutAMarkFrameNumbersAreCompared) {
  Result slower = Read({});
  for (PoseRow& row : slower.poses) row.timestamp_ns -= row.frame * kPeriodNs / 2;
  EXPECT_THAT(Remarks(slower), ElementsAre(HasSubstr("50.0 ms apart")));
  Result sparse = Read({});
  std::erase_if(sparse.poses, [](const PoseRow& row) { return row.frame % 3 != 0; });
  EXPECT_THAT(Remarks(sparse), IsEmpty()) << "one of several people may be there now and then";
}

TEST_F(TakeIdentityTest, ResultsOfFewerFramesAreComparedWithTheSlowestCamera) {
  const std::filesystem::path table = take_ / "north.csv";
  std::istringstream rows(testing::ReadText(table));
  std::string row, every_other;
  std::getline(rows, row);
  every_other = row + '\n';
  for (int i = 0; std::getline(rows, row); ++i)
    if (i % 2 == 0) every_other += row + '\n';
  testing::WriteText(table, every_other);
  Result slower = Read({});
  for (PoseRow& pose : slower.poses) pose.frame /= 4;
  const auto is_same_set = [](const PoseRow& a, const PoseRow& b) { return a.frame == b.frame; };
  const auto [first, last] = std::ranges::unique(slower.poses, is_same_set);
  slower.poses.erase(first, last);
  EXPECT_THAT(Remarks(slower), ElementsAre(AllOf(HasSubstr("400.0 ms apart"),
                                                 HasSubstr(" 200.0 ms; check that it is of"))));
}

TEST_F(TakeIdentityTest, ALogOfOtherTimesIsTold) {
  const std::filesystem::path log = folder_.path() / "log";
  testing::WriteText(log, "");
  Result played_again = Read({});
  for (PoseRow& row : played_again.poses) row.timestamp_ns += 1000 * kPeriodNs;
  TakeIdentity(take_).Require(log, played_again);
  EXPECT_THAT(played_again.remarks,
              ElementsAre(HasSubstr("; check that it was made of this take")));
}

TEST_F(TakeIdentityTest, TakeAndResultExchangedAreNamed) {
  const std::string take = take_.string(), result = result_.string();
  const auto is_result = HasSubstr("is a result of tracking, not a take");
  const auto is_take = HasSubstr("is a take, not a result");
  const auto evaluated = [](const std::string& words) {
    return SetupErrorOf([&] { testing::RunCommand(AddEvaluateCommand, "evaluate " + words); });
  };
  EXPECT_THAT(evaluated(result + ' ' + take), is_result);
  EXPECT_THAT(evaluated(result + ' ' + result), is_result);
  EXPECT_THAT(evaluated(take + ' ' + take), is_take);
  EXPECT_THAT(SetupErrorOf([&] { TakeSite(result_, {}); }), is_result);
  EXPECT_THAT(SetupErrorOf([&] { TakeSite(take_, {take_}); }), is_take);
  EXPECT_THAT(SetupErrorOf([&] {
                testing::RunCommand(AddTrackCommand, "track " + result + " --out " + take + "-r");
              }),
              is_result);
  EXPECT_THAT(SetupErrorOf([&] {
                testing::RunCommand(AddExportCommand,
                                    "export " + take + " --format csv --out " + take + ".csv");
              }),
              is_take);
}

TEST_F(TakeIdentityTest, ATakeOfSeveralPeopleIsNoResultOfThem) {
  std::filesystem::create_directory(take_ / "person-1");
  std::filesystem::rename(take_ / "truth.csv", take_ / "person-1" / "truth.csv");
  EXPECT_FALSE(IsOfPeople(take_));
  for (const auto& read :
       std::vector<std::function<void()>>{[&] { ReadPeople(take_); }, [&] { ReadResult(take_); }}) {
    EXPECT_THAT(SetupErrorOf(read), HasSubstr("is a take, not a result"));
  }
}

TEST_F(TakeIdentityTest, AResultOfOneAndOneOfSeveralPeopleAreTold) {
  WritePeople(folder_.path() / "many", {{3, ReadResult(result_)}});
  EXPECT_THAT(SetupErrorOf([&] { ReadResult(folder_.path() / "many"); }),
              AllOf(HasSubstr("a result of several people"), HasSubstr("many/person-3")));
  EXPECT_THAT(SetupErrorOf([&] { ReadPeople(result_); }), HasSubstr("a result of one person"));
  EXPECT_THAT(SetupErrorOf([&] { OpenTake(folder_.path() / "many", {}); }),
              HasSubstr("is a result of tracking, not a take"));
}

}  // namespace
}  // namespace mocap
