// §8.2: precision: distance of the tracking output from its own smoothed curve, which replaces the
// truth where there is none.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/body/body_model.h"
#include "core/body/body_part.h"
#include "core/body/pose_state.h"

namespace mocap {

/// Polynomial order M and window of 2n + 1 frames; the defaults are the paper's.
struct SmoothingOptions {
  int order = 3;
  int half_window = 7;
};

/// Smooths a series: each value is replaced by that of a polynomial, fitted by least squares to the
/// window around it.
///
/// Savitzky and Golay, 1964; Mikić et al. 2003, §8.2. Within half a window from an end, the
/// polynomial of the first or last whole window is evaluated. So a polynomial of the given order is
/// reproduced everywhere. A series shorter than the window is one window.
///
/// @param series  equally spaced in time.
/// @return  as long as the series.
Eigen::VectorXd SmoothSavitzkyGolay(const Eigen::VectorXd& series, const SmoothingOptions& options);

/// Removes jumps of whole turns between neighbours in a series of angles [rad].
Eigen::VectorXd UnwrapAngles(const Eigen::VectorXd& angles_rad);

/// One tracked frame.
struct PoseSample {
  PaperState paper;
  BodyPoints points_W = BodyPoints::Zero();
};

/// Mean absolute differences between the output and its smoothed curve.
struct Precision {
  int frames = 0;                                    ///< Number of frames in the means.
  std::array<double, kPaperAngleCount> angle_rad{};  ///< θ1 … θ16.
  double mean_angle_rad = 0;
  double mean_angle_without_twist_rad =
      0;  ///< Without θ7 and θ8, undefined when an arm is straight.
  std::array<double, kPointCount> point_mm{};  ///< Distance of each point from its smoothed path.
  double mean_point_mm = 0;
};

/// Measures precision over unbroken runs of tracked frames. Runs shorter than the window are left
/// out; empty if no run is left.
std::optional<Precision> MeasurePrecision(std::span<const std::vector<PoseSample>> runs,
                                          const SmoothingOptions& options);

}  // namespace mocap
