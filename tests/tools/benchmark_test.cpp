#include "tools/benchmark.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "drivers/take/text_file.h"
#include "tests/support/run_command.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tools/accuracy/score_table.h"
#include "tools/simulate.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string Benchmark(const std::string& arguments) {
  ::testing::internal::CaptureStdout();
  testing::RunCommand(AddBenchmarkCommand, "benchmark " + arguments);
  return ::testing::internal::GetCapturedStdout();
}

std::string BenchmarkFault(const std::string& arguments) {
  return testing::SetupErrorOf(
      [&] { testing::RunCommand(AddBenchmarkCommand, "benchmark " + arguments); });
}

TEST(Benchmark, TakesAndTheirFoldersBelongTogether) {
  EXPECT_THAT(BenchmarkFault("--parts takes"), HasSubstr("--parts takes: needs --takes"));
  EXPECT_THAT(BenchmarkFault("--parts paper --takes ."), HasSubstr("expected --parts takes"));
  EXPECT_THAT(BenchmarkFault("--parts takes --takes /no/such"), HasSubstr("/no/such"));
}

TEST(Benchmark, TakesAreScoredAndTheirTablesWrittenToBeCompared) {
  const testing::TemporaryFolder folder;
  const fs::path take = folder.path() / "some" / "walk", out = folder.path() / "out";
  testing::RunCommand(AddSimulateCommand,
                      "simulate --cameras 4 --width 160 --height 120 --fps 10 --seconds 1 "
                      "--motion walk --out " +
                          take.string());
  const std::string said = Benchmark("--parts takes --firsts 2 --takes " +
                                     take.parent_path().string() + " --out " + out.string());
  EXPECT_THAT(said, AllOf(HasSubstr("recorded takes, some"), HasSubstr("\nwalk "),
                          HasSubstr("\nsome: 1 people")));
  EXPECT_THAT(testing::ReadText(out / "accuracy.md"),
              AllOf(HasSubstr("## Recorded takes"), HasSubstr("| walk | ")));
  const fs::path scores = out / "scores.csv";
  ASSERT_EQ(ReadScores(scores).size(), 2u);
  const std::string same = scores.string();
  EXPECT_THAT(
      Benchmark("compare " + same + " " + same),
      AllOf(HasSubstr("takes, some"), HasSubstr("+0.00 to +0.00"), HasSubstr("too few people")));
}

TEST(Benchmark, VariedPeopleHaveTheirNumbersAndAreFilmedAsAsked) {
  const testing::TemporaryFolder folder;
  ::testing::internal::CaptureStdout();
  CLI::App app("mocap");
  AddBenchmarkCommand(app);
  app.parse(std::vector<std::string>{folder.path().string(), "--out", "1", "--seconds", "1",
                                     "--seeds", "9", "--from", "10 Hz", "--filmed", "variety",
                                     "--parts", "benchmark"});
  EXPECT_THAT(::testing::internal::GetCapturedStdout(), HasSubstr("varied people, 10 Hz\n"));
  const std::vector<ScoreRow> scores = ReadScores(folder.path() / "scores.csv");
  ASSERT_EQ(scores.size(), 1u);
  EXPECT_EQ(scores[0].group, "10 Hz");
  EXPECT_EQ(scores[0].person, "9");
}

TEST(Benchmark, WhatIsNoScoresIsNotOverwritten) {
  const testing::TemporaryFolder folder;
  WriteText(folder.path() / "scores.csv", "my,own,table\n");
  EXPECT_THAT(BenchmarkFault("--parts variety --out " + folder.path().string()),
              HasSubstr("scores.csv"));
  EXPECT_EQ(testing::ReadText(folder.path() / "scores.csv"), "my,own,table\n");
}

}  // namespace
}  // namespace mocap
