#include "tools/accuracy/takes_trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <utility>
#include <vector>

#include "tests/support/run_command.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tools/simulate.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A walker and two people, in takes so small that it is a matter of seconds.
class TakesTracked : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new testing::TemporaryFolder;
    const std::string small = "simulate --cameras 4 --width 320 --height 240 --fps 10 --seconds ";
    testing::RunCommand(AddSimulateCommand,
                        small + "1.2 --motion walk --out " + (Takes() / "walk").string());
    testing::RunCommand(AddSimulateCommand,
                        small + "1 --motion walk --people 2 --out " + (Takes() / "two").string());
  }
  static void TearDownTestSuite() { delete std::exchange(folder_, nullptr); }

  static fs::path Takes() { return folder_->path() / "some"; }

  static inline testing::TemporaryFolder* folder_ = nullptr;
};

TEST_F(TakesTracked, AFolderAndATakeAreFound) {
  const std::vector<TakesFolder> found = FoldersOfTakes({Takes()});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "some");
  EXPECT_THAT(found[0].takes, ::testing::ElementsAre(Takes() / "two", Takes() / "walk"));
  EXPECT_THAT(FoldersOfTakes({Takes() / "walk"})[0].takes,
              ::testing::ElementsAre(Takes() / "walk"));
}

TEST_F(TakesTracked, TakesWithoutTruthAreToldAndLeftOut) {
  const fs::path other = folder_->path() / "other";
  fs::create_directories(other);
  EXPECT_THAT(testing::SetupErrorOf([&] { FoldersOfTakes({other}); }),
              HasSubstr("has no take with truth"));
  fs::copy(Takes() / "walk", other / "untold", fs::copy_options::recursive);
  fs::copy(Takes() / "walk", other / "walk", fs::copy_options::recursive);
  fs::remove(other / "untold" / "truth.csv");
  const std::vector<TakesFolder> found = FoldersOfTakes({other});
  EXPECT_THAT(found[0].takes, ::testing::ElementsAre(other / "walk"));
  ASSERT_EQ(found[0].remarks.size(), 1u);
  EXPECT_THAT(found[0].remarks[0], HasSubstr("untold: has no truth"));
  EXPECT_THAT(testing::SetupErrorOf([&] {
                FoldersOfTakes({Takes(), Takes()});
              }),
              HasSubstr("names two folders some"));
}

TEST_F(TakesTracked, EveryRunOnOnePersonIsScoredInTheSameSets) {
  const ScoredTake row = RunTakeTrial(Takes() / "walk", 3);
  ASSERT_EQ(row.people.size(), 1u);
  const TakePerson& person = row.people.front();
  EXPECT_EQ(person.name, "walk");
  ASSERT_EQ(person.score.firsts.size(), 3u);
  EXPECT_GT(person.score.sets, 5);
  EXPECT_LE(person.score.sets, 10) << "the first two of twelve sets belong to no score";
  for (const FirstScore& first : person.score.firsts) {
    ASSERT_TRUE(first.errors);
    EXPECT_LT(first.errors->mean_mm, 150);
    EXPECT_LE(first.tracked_share, 1);
    EXPECT_GE(10 * first.tracked_share, person.score.sets - 1e-9);
  }
  EXPECT_THAT(TakesSummaryText({"some", {row}}), HasSubstr("some: 1 people, 0 never tracked"));
}

TEST_F(TakesTracked, EachOfSeveralPeopleHasALine) {
  const ScoredTake row = RunTakeTrial(Takes() / "two", 2);
  ASSERT_EQ(row.people.size(), 2u);
  EXPECT_THAT(TakeLines(row), AllOf(HasSubstr("two/person-1 "), HasSubstr("two/person-2 ")));
  for (const TakePerson& person : row.people) {
    EXPECT_GT(person.score.tracked_share(), 0.5) << person.name;
    EXPECT_GT(person.score.sets, 3) << person.name;
  }
  EXPECT_THAT(TakesMarkdown({{"some", {row}}}, 2),
              AllOf(HasSubstr("tracked 2 times"), HasSubstr("| two/person-2 | ")));
}

TEST_F(TakesTracked, MoreFirstSetsThanThereAreAreRefused) {
  EXPECT_THAT(testing::SetupErrorOf([] { RunTakeTrial(Takes() / "two", 11); }),
              HasSubstr("two: has 10 frame sets; expected at least 11"));
}

}  // namespace
}  // namespace mocap
