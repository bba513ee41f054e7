// §4: the lookup table from the undistorted sensor plane to pixels.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/kernels/octants.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Maps quantised (Xu/f, Yu/f) to pixels, with an error far below half a pixel.
///
/// The table depends on the lens alone. It is built once and serves every pan and tilt; no lens is
/// evaluated at run time. Mikić et al. 2003, §4. The paper's table has one cell per pixel. Here
/// cells are several pixels wide and interpolated between their corners, so that the table stays in
/// the cache. What remains of the half pixel is rounding to a whole pixel. Reentrant.
class SensorPlaneTable {
 public:
  struct Pixel {
    std::int16_t x = -1;  ///< Negative: outside the picture.
    std::int16_t y = -1;
  };
  /// A position in the picture, between pixel centres.
  using Place = kernels::PicturePlace;

  /// @throws SetupError  if the lens shows nothing in its picture.
  explicit SensorPlaneTable(const CameraCalibration& camera);

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }

  /// Finds the pixel of a direction. Outside the picture both coordinates are negative.
  Pixel Lookup(double xu_over_f, double yu_over_f) const {
    Place place;
    if (!Locate(static_cast<float>(xu_over_f), static_cast<float>(yu_over_f), place)) return {};
    return PixelAt(place);
  }

  /// Finds where a direction meets the picture's plane, also slightly outside the picture.
  /// @return  false outside the table: the position is then outside the picture.
  bool Locate(float xu_over_f, float yu_over_f, Place& place) const {
    const float u = (xu_over_f - origin_x_) * cells_per_unit_;
    const float v = (yu_over_f - origin_y_) * cells_per_unit_;
    // Also false for NaN.
    if (!(u >= 0 && v >= 0 && u < last_column_ && v < last_row_)) return false;
    if (xu_over_f * xu_over_f + yu_over_f * yu_over_f > farthest_sq_) return false;
    const int column = static_cast<int>(u);
    const int row = static_cast<int>(v);
    const float a = u - static_cast<float>(column);
    const float b = v - static_cast<float>(row);
    const Place* top = &nodes_[static_cast<std::size_t>(row) * columns_ + column];
    const Place* bottom = top + columns_;
    const float top_x = top[0].x_px + a * (top[1].x_px - top[0].x_px);
    const float top_y = top[0].y_px + a * (top[1].y_px - top[0].y_px);
    const float bottom_x = bottom[0].x_px + a * (bottom[1].x_px - bottom[0].x_px);
    const float bottom_y = bottom[0].y_px + a * (bottom[1].y_px - bottom[0].y_px);
    place = {top_x + b * (bottom_x - top_x), top_y + b * (bottom_y - top_y)};
    return true;
  }

  /// Rounds a position to its pixel. Outside the picture both coordinates are negative.
  Pixel PixelAt(const Place& place) const {
    const float x = place.x_px + 0.5f;
    const float y = place.y_px + 0.5f;
    if (!(x >= 0 && y >= 0 && x < static_cast<float>(width_px_) &&
          y < static_cast<float>(height_px_)))
      return {};
    return {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)};
  }

  /// The table in the form that loops over many directions need.
  using Nodes = kernels::SensorPlaneNodes;
  static constexpr int kBendReach_cells = kernels::kBendReach_cells;
  Nodes nodes() const {
    return {nodes_.data(),
            columns_,
            origin_x_,
            origin_y_,
            cells_per_unit_,
            last_column_,
            last_row_,
            static_cast<float>(field_radius_),
            static_cast<float>(low_.x()),
            static_cast<float>(low_.y()),
            static_cast<float>(high_.x()),
            static_cast<float>(high_.y()),
            bends_px_.data()};
  }

  /// An upright rectangle of (Xu/f, Yu/f).
  struct Window {
    Vector2 low = Vector2::Zero();
    Vector2 high = Vector2::Zero();
  };
  /// Finds a window that contains every direction within a rectangle of the picture. It is a few
  /// pixels too wide at most.
  /// @param left, top, right, bottom  the rectangle's outermost pixels, inclusive.
  Window WindowOf(int left, int top, int right, int bottom) const;
  /// Finds a window that contains only directions in the picture. It is empty, its low side above
  /// its high one, if the picture shows the rim of the lens.
  Window InnerWindow() const;

 private:
  bool FillNodes(const Lens& lens, double cell);
  double WorstError_px(const Lens& lens) const;
  void MeasureBends();

  int width_px_ = 0, height_px_ = 0;
  // The part of the sensor plane that the picture shows.
  Vector2 low_ = Vector2::Zero(), high_ = Vector2::Zero();
  double field_radius_ = 0;
  float farthest_sq_ = 0;

  float origin_x_ = 0, origin_y_ = 0;
  float cells_per_unit_ = 0;
  int columns_ = 0, rows_ = 0;
  float last_column_ = 0, last_row_ = 0;
  std::vector<Place> nodes_;
  std::vector<float> bends_px_;  // For the cell right of and below each node.

  // Directions of pixel corners, every kDirectionStep_px pixels, for WindowOf.
  int direction_columns_ = 0, direction_rows_ = 0;
  std::vector<Vector2> directions_;
};

}  // namespace mocap
