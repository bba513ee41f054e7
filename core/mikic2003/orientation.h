// §7.3: distinguishes left from right. Fig. 14.
#pragma once

#include <array>
#include <optional>

#include "core/body/body_model.h"
#include "core/mikic2003/pose_ekf.h"

namespace mocap::mikic2003 {

/// Swaps the points of left and right.
MeasuredPoints ExchangeSides(const MeasuredPoints& points);

/// A body that is tracked in both orientations until one fits clearly better.
///
/// "A significant difference" of the fits is a fifth. The decision waits until the sizes have
/// settled: until then both fits are bad.
class OrientedBody {
 public:
  /// Fits both orientations to the points of the first frame.
  /// @param R_WT    of the torso in one orientation.
  /// @param points  with the sides of that orientation.
  OrientedBody(const BodyModel& body, const Matrix3& R_WT, const MeasuredPoints& points);

  void Predict(double dt_s);
  /// Fits the remaining orientations to the points of a frame.
  /// @param points  with the sides of best().
  /// @param may_decide  whether a clear difference counts.
  void Update(const BodyModel& body, const MeasuredPoints& points, bool may_decide);

  /// The orientation that fits better so far.
  const PoseEkf& best() const { return filters_[best_]; }
  /// Whether one orientation has fitted clearly better.
  bool is_decided() const { return is_decided_; }
  /// Mean distance between measured points and those of best() [mm].
  double residual_mm() const { return residual_mm_; }

 private:
  void Adjust(const BodyModel& body, const MeasuredPoints& points, int iterations, bool may_decide);

  std::array<PoseEkf, 2> filters_;
  int best_ = 0;
  bool is_decided_ = false;
  double residual_mm_ = 0;
};

}  // namespace mocap::mikic2003
