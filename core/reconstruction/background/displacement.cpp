#include "core/reconstruction/background/displacement.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/geometry.h"
#include "core/kernels/statistics.h"
#include "core/reconstruction/background/expected_picture.h"

namespace mocap {
namespace {

// Limit for the smaller eigenvalue of the normal equations [grey levels²]. Noise of 2 grey levels
// then shifts the result by 0.05 px.
constexpr double kLeastEvidence = 2000;

}  // namespace

std::optional<Displacement> MeasureDisplacement(const HalfPicture& live, float gain,
                                                const ExpectedHalf& expected) {
  MOCAP_CHECK(live.width == expected.mean.width && live.height == expected.mean.height);
  // Gradients in and beside the padding mean nothing.
  const int margin = HalfPicture::kTile + 1, margin_below = HalfPicture::kTileRows + 2;
  kernels::GradientSums sums;
  const auto fixed_gain = static_cast<int>(std::lround(gain * (1 << kernels::kGainBits)));
  for (int y = 2; y < live.height - margin_below; ++y) {
    const std::size_t i = static_cast<std::size_t>(y) * live.width + 1;
    kernels::AddGradients(&live.color[1][i], &expected.mean.color[1][i], &expected.variance[i],
                          live.width, fixed_gain, kUnknownVariance, live.width - margin - 1, sums);
  }
  Eigen::Matrix2d normal;
  normal << static_cast<double>(sums.xx), static_cast<double>(sums.xy),
      static_cast<double>(sums.xy), static_cast<double>(sums.yy);
  normal /= 4;
  const Vector2 right = Vector2(static_cast<double>(sums.xd), static_cast<double>(sums.yd)) / 2;
  const double half_trace = normal.trace() / 2;
  const double lesser =
      half_trace - std::sqrt(std::max(half_trace * half_trace - normal.determinant(), 0.0));
  if (lesser < kLeastEvidence) return std::nullopt;
  // A pixel of the half picture is two pixels wide. The expected pixel x is seen at x +
  // displacement.
  const Vector2 moved = -normal.inverse() * right;
  return Displacement{static_cast<float>(2 * moved.x()),
                      static_cast<float>(HalfPicture::kRowStep_px * moved.y())};
}

}  // namespace mocap
