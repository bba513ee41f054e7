// The whole path, held to the numbers that it gave before.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/run_command.h"
#include "tests/support/temporary_folder.h"
#include "tools/simulate.h"
#include "tools/track.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

std::vector<std::vector<std::string>> Rows(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    for (rows.emplace_back(); std::getline(cells, line, ',');) rows.back().push_back(line);
  }
  return rows;
}

// Compilers round differently, and a fit may turn on that; a change of the method shows as more.
double ToleranceOf(const std::string& column) {
  if (column.ends_with("_mm")) return 3;
  if (column.ends_with("_rad")) return 0.05;
  if (column == "voxels") return 5;
  return 1e-3;
}

TEST(Golden, ASimulatedWalkGivesThePosesThatItGaveBefore) {
  const testing::TemporaryFolder folder;
  const fs::path take = folder.path() / "take";
  const fs::path result = folder.path() / "result";
  testing::RunCommand(AddSimulateCommand,
                      "simulate --motion walk --seconds 0.3 --seed 3 --out " + take.string());
  testing::RunCommand(AddTrackCommand, "track " + take.string() + " --out " + result.string());
  const auto got = Rows(testing::ReadText(result / "poses.csv"));
  const auto golden =
      Rows(testing::ReadText(fs::path(MOCAP_SOURCE_DIR) / "tests/tools/golden/poses.csv"));
  ASSERT_EQ(got.size(), golden.size());
  ASSERT_EQ(got[0], golden[0]);
  for (std::size_t row = 1; row < golden.size(); ++row) {
    ASSERT_EQ(got[row].size(), golden[row].size());
    for (std::size_t i = 0; i < golden[row].size(); ++i) {
      const std::string& column = golden[0][i];
      if (column == "state" || column == "timestamp_ns" || golden[row][i].empty()) {
        EXPECT_EQ(got[row][i], golden[row][i]) << column << " of row " << row;
      } else {
        EXPECT_NEAR(std::stod(got[row][i]), std::stod(golden[row][i]), ToleranceOf(column))
            << column << " of row " << row;
      }
    }
  }
}

}  // namespace
}  // namespace mocap
