#include "core/reconstruction/camera/sensor_plane_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.h"

namespace mocap {
namespace {

constexpr int kDirectionStep_px = 8;
constexpr double kWidestCell_px = 16;
constexpr double kNarrowestCell_px = 4;
// A table may err by half a pixel. All but this much is left to rounding.
constexpr double kWantedError_px = 0.02;
// Half a gigabyte: far more than any lens needs.
constexpr double kMostNodes = 1 << 26;

}  // namespace

SensorPlaneTable::SensorPlaneTable(const CameraCalibration& camera)
    : width_px_(camera.width_px),
      height_px_(camera.height_px),
      field_radius_(FieldRadius(camera.lens)) {
  MOCAP_CHECK(width_px_ > 0 && height_px_ > 0 && width_px_ < 32768 && height_px_ < 32768);
  // Directions of pixel corners, from one step before the picture to one step after it.
  direction_columns_ = (width_px_ - 1) / kDirectionStep_px + 2;
  direction_rows_ = (height_px_ - 1) / kDirectionStep_px + 2;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  low_.setConstant(kInfinity);
  high_.setConstant(-kInfinity);
  bool beyond_the_rim = false;
  for (int row = 0; row < direction_rows_; ++row) {
    for (int column = 0; column < direction_columns_; ++column) {
      const Vector2 corner(column * kDirectionStep_px - 0.5, row * kDirectionStep_px - 0.5);
      const std::optional<Vector2> direction = NormalizedFromPixel(camera.lens, corner);
      directions_.push_back(direction.value_or(Vector2::Constant(kInfinity)));
      if (!direction) {
        beyond_the_rim = true;
        continue;
      }
      low_ = low_.cwiseMin(*direction);
      high_ = high_.cwiseMax(*direction);
    }
  }
  const auto refuse = [&](const std::string& what) {
    throw SetupError("camera " + camera.name + ": the lens " + what + " in its picture of " +
                     std::to_string(width_px_) + " x " + std::to_string(height_px_) +
                     " px; expected a focal length, centre and distortion that fit it");
  };
  if (!(low_.array() < high_.array()).all()) refuse("shows nothing");
  if (beyond_the_rim) {
    low_.setConstant(-field_radius_);
    high_.setConstant(field_radius_);
  }
  farthest_sq_ = static_cast<float>(field_radius_ * field_radius_);

  const double densest = [&] {
    const Vector2 middle = 0.5 * (low_ + high_);
    const double h = 1e-3 * (high_ - low_).norm();
    double most = 0;
    for (const Vector2& at : {Vector2(middle), Vector2(0, 0), low_, high_}) {
      const auto a = PixelFromNormalized(camera.lens, at);
      const auto b = PixelFromNormalized(camera.lens, at + Vector2(h, 0));
      const auto c = PixelFromNormalized(camera.lens, at + Vector2(0, h));
      if (a && b && c) most = std::max({most, (*b - *a).norm() / h, (*c - *a).norm() / h});
    }
    return most;
  }();
  for (double cell_px = kWidestCell_px; cell_px >= kNarrowestCell_px; cell_px /= 2) {
    const double cell = cell_px / densest;
    const Vector2 cells = (high_ - low_) / cell;
    if (!((cells.x() + 3) * (cells.y() + 3) < kMostNodes)) refuse("spreads directions too far");
    if (!FillNodes(camera.lens, cell)) refuse("has a radius that folds back and forth");
    if (WorstError_px(camera.lens) < kWantedError_px) break;
  }
  MeasureBends();
}

bool SensorPlaneTable::FillNodes(const Lens& lens, double cell) {
  // One extra cell on each side of the picture.
  columns_ = static_cast<int>(std::ceil((high_.x() - low_.x()) / cell)) + 3;
  rows_ = static_cast<int>(std::ceil((high_.y() - low_.y()) / cell)) + 3;
  origin_x_ = static_cast<float>(low_.x() - cell);
  origin_y_ = static_cast<float>(low_.y() - cell);
  cells_per_unit_ = static_cast<float>(1 / cell);
  last_column_ = static_cast<float>(columns_ - 1);
  last_row_ = static_cast<float>(rows_ - 1);
  nodes_.clear();
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      Vector2 at(low_.x() + (column - 1) * cell, low_.y() + (row - 1) * cell);
      // A node beyond the rim gets the rim's position, because visible cells have it as a corner.
      const double inside = field_radius_ * (1 - 1e-9);
      if (at.norm() > inside) at *= inside / at.norm();
      const std::optional<Vector2> place = PixelFromNormalized(lens, at);
      // Two turning points are so close together that only one of two searches finds them.
      if (!place) return false;
      nodes_.push_back({static_cast<float>(place->x()), static_cast<float>(place->y())});
    }
  }
  return true;
}

double SensorPlaneTable::WorstError_px(const Lens& lens) const {
  double worst = 0;
  for (int row = 0; row + 1 < rows_; ++row) {
    for (int column = 0; column + 1 < columns_; ++column) {
      const float x = origin_x_ + (static_cast<float>(column) + 0.5f) / cells_per_unit_;
      const float y = origin_y_ + (static_cast<float>(row) + 0.5f) / cells_per_unit_;
      Place place;
      const std::optional<Vector2> exact = PixelFromNormalized(lens, Vector2(x, y));
      if (!exact || !Locate(x, y, place) || PixelAt(place).x < 0) continue;
      worst = std::max(worst, (*exact - Vector2(place.x_px, place.y_px)).norm());
    }
  }
  return worst;
}

void SensorPlaneTable::MeasureBends() {
  const auto node = [&](int row, int column) {
    const Place& p = nodes_[static_cast<std::size_t>(std::min(row, rows_ - 1)) * columns_ +
                            std::min(column, columns_ - 1)];
    return Eigen::Vector2f(p.x_px, p.y_px);
  };
  const auto bend = [&](int row, int column) {
    const Eigen::Vector2f here = node(row, column);
    const Eigen::Vector2f right = node(row, column + 1), below = node(row + 1, column);
    float largest = (node(row + 1, column + 1) - right - below + here).lpNorm<Eigen::Infinity>();
    if (column + 2 < columns_)
      largest =
          std::max(largest, (node(row, column + 2) - 2 * right + here).lpNorm<Eigen::Infinity>());
    if (row + 2 < rows_)
      largest =
          std::max(largest, (node(row + 2, column) - 2 * below + here).lpNorm<Eigen::Infinity>());
    return largest;
  };
  bends_px_.assign(nodes_.size(), 0);
  for (int row = 0; row + 1 < rows_; ++row) {
    for (int column = 0; column + 1 < columns_; ++column) {
      const float here = bend(row, column);
      // The bend lies at the far sides of this cell.
      for (int y = row - kBendReach_cells; y <= row + kBendReach_cells + 1; ++y)
        for (int x = column - kBendReach_cells; x <= column + kBendReach_cells + 1; ++x)
          if (y >= 0 && x >= 0 && y < rows_ && x < columns_) {
            float& largest = bends_px_[static_cast<std::size_t>(y) * columns_ + x];
            largest = std::max(largest, here);
          }
    }
  }
}

SensorPlaneTable::Window SensorPlaneTable::InnerWindow() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Window nothing{Vector2::Constant(kInfinity), Vector2::Constant(-kInfinity)};
  Window window{nothing.high, nothing.low};
  // The last directions may lie outside the picture.
  const int right = (width_px_ - 1) / kDirectionStep_px;
  const int bottom = (height_px_ - 1) / kDirectionStep_px;
  for (int row = 0; row <= bottom; ++row) {
    for (int column = 0; column <= right; ++column) {
      const Vector2& n = directions_[static_cast<std::size_t>(row) * direction_columns_ + column];
      if (!n.allFinite()) return nothing;
      if (column == 0) window.low.x() = std::max(window.low.x(), n.x());
      if (column == right) window.high.x() = std::min(window.high.x(), n.x());
      if (row == 0) window.low.y() = std::max(window.low.y(), n.y());
      if (row == bottom) window.high.y() = std::min(window.high.y(), n.y());
    }
  }
  return window;
}

SensorPlaneTable::Window SensorPlaneTable::WindowOf(int left, int top, int right,
                                                    int bottom) const {
  const int first_column = left / kDirectionStep_px;
  const int first_row = top / kDirectionStep_px;
  const int last_column = right / kDirectionStep_px + 1;
  const int last_row = bottom / kDirectionStep_px + 1;
  Window window;
  window.low.setConstant(std::numeric_limits<double>::infinity());
  window.high = -window.low;
  bool beyond_the_rim = false;
  for (int row = first_row; row <= last_row; ++row) {
    // A lens maps the interior of the rectangle into the image of its outline.
    const bool edge_row = row == first_row || row == last_row;
    const int step = edge_row ? 1 : last_column - first_column;
    for (int column = first_column; column <= last_column; column += step) {
      const Vector2& n = directions_[static_cast<std::size_t>(row) * direction_columns_ + column];
      if (!n.allFinite()) {
        beyond_the_rim = true;
        continue;
      }
      window.low = window.low.cwiseMin(n);
      window.high = window.high.cwiseMax(n);
    }
  }
  if (beyond_the_rim) return {Vector2::Constant(-field_radius_), Vector2::Constant(field_radius_)};
  return window;
}

}  // namespace mocap
