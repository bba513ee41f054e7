#include "core/evaluation/assignment.h"

#include <algorithm>
#include <limits>

namespace mocap {
namespace {

// Rows and columns of a cost matrix, counted from 1. Column 0 holds the row that is being added.
class Matching {
 public:
  explicit Matching(const Eigen::MatrixXd& cost)
      : cost_(cost),
        row_price_(Eigen::VectorXd::Zero(cost.rows() + 1)),
        column_price_(Eigen::VectorXd::Zero(cost.cols() + 1)),
        row_of_(cost.cols() + 1, 0) {}

  // Assigns a column to one more row at the least cost; other rows may change columns.
  void Add(int row) {
    const int columns = static_cast<int>(cost_.cols());
    std::vector<double> least(columns + 1, std::numeric_limits<double>::infinity());
    std::vector<int> before(columns + 1, 0);
    std::vector<bool> is_seen(columns + 1, false);
    row_of_[0] = row;
    int column = 0;
    while (row_of_[column] != 0) {
      is_seen[column] = true;
      int next = 0;
      for (int j = 1; j <= columns; ++j) {
        if (is_seen[j]) continue;
        const double reduced = Reduced(row_of_[column], j);
        if (reduced < least[j]) least[j] = reduced, before[j] = column;
        if (next == 0 || least[j] < least[next]) next = j;
      }
      const double step = least[next];
      for (int j = 0; j <= columns; ++j) {
        if (is_seen[j]) {
          row_price_[row_of_[j]] += step;
          column_price_[j] -= step;
        } else {
          least[j] -= step;
        }
      }
      column = next;
    }
    for (; column != 0; column = before[column]) row_of_[column] = row_of_[before[column]];
  }

  int RowOf(int column) const { return row_of_[column]; }

 private:
  double Reduced(int row, int column) const {
    return cost_(row - 1, column - 1) - row_price_[row] - column_price_[column];
  }

  const Eigen::MatrixXd& cost_;
  Eigen::VectorXd row_price_, column_price_;
  std::vector<int> row_of_;  // 0: free.
};

}  // namespace

std::vector<int> AssignForMost(const Eigen::MatrixXd& gain) {
  const int rows = static_cast<int>(gain.rows()), columns = static_cast<int>(gain.cols());
  // Adds one column per row, without gain.
  Eigen::MatrixXd cost = Eigen::MatrixXd::Zero(rows, columns + rows);
  cost.leftCols(columns) = -gain.cwiseMax(0);
  Matching matching(cost);
  for (int row = 1; row <= rows; ++row) matching.Add(row);
  std::vector<int> column_of(rows, -1);
  for (int column = 0; column < columns; ++column) {
    const int row = matching.RowOf(column + 1) - 1;
    if (row >= 0 && gain(row, column) > 0) column_of[row] = column;
  }
  return column_of;
}

}  // namespace mocap
