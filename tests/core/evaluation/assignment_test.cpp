#include "core/evaluation/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace mocap {
namespace {

double SumOf(const Eigen::MatrixXd& gain, const std::vector<int>& column_of) {
  double sum = 0;
  for (std::size_t i = 0; i < column_of.size(); ++i)
    if (column_of[i] >= 0) sum += gain(static_cast<Eigen::Index>(i), column_of[i]);
  return sum;
}

// All ways to give rows columns, or none.
double MostByTrial(const Eigen::MatrixXd& gain, Eigen::Index row, std::vector<bool>& used) {
  if (row == gain.rows()) return 0;
  double most = MostByTrial(gain, row + 1, used);
  for (Eigen::Index j = 0; j < gain.cols(); ++j) {
    if (used[j]) continue;
    used[j] = true;
    most = std::max(most, gain(row, j) + MostByTrial(gain, row + 1, used));
    used[j] = false;
  }
  return most;
}

TEST(Assignment, GainsAsMuchAsTheBestOfAllWays) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> size(1, 5), value(-3, 9);
  for (int trial = 0; trial < 300; ++trial) {
    Eigen::MatrixXd gain(size(random), size(random));
    for (double& number : gain.reshaped()) number = value(random);
    const std::vector<int> column_of = AssignForMost(gain);
    ASSERT_EQ(column_of.size(), static_cast<std::size_t>(gain.rows()));
    std::vector<int> columns = column_of;
    std::erase(columns, -1);
    std::ranges::sort(columns);
    EXPECT_TRUE(std::ranges::adjacent_find(columns) == columns.end()) << "one to one";
    for (std::size_t i = 0; i < column_of.size(); ++i)
      if (column_of[i] >= 0) {
        EXPECT_GT(gain(static_cast<Eigen::Index>(i), column_of[i]), 0);
      }
    std::vector<bool> used(gain.cols());
    EXPECT_DOUBLE_EQ(SumOf(gain, column_of), MostByTrial(gain, 0, used));
  }
}

TEST(Assignment, OfNobodyIsNobody) {
  EXPECT_TRUE(AssignForMost(Eigen::MatrixXd(0, 3)).empty());
  EXPECT_EQ(AssignForMost(Eigen::MatrixXd(2, 0)), (std::vector<int>{-1, -1}));
}

}  // namespace
}  // namespace mocap
