#include "core/reconstruction/background/displacement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/errors.h"
#include "core/geometry.h"
#include "core/reconstruction/background/expected_picture.h"
#include "core/vectorized.h"

namespace mocap {
namespace {

constexpr int kFractionBits = 8;
// A displacement explains differences up to this [grey levels] plus this many gradients.
constexpr int kExplained = 4;
constexpr int kExplainedGradients = 1;
// Limit for the smaller eigenvalue of the normal equations [grey levels²]. Noise of 2 grey levels
// then shifts the result by 0.05 px.
constexpr double kLeastEvidence = 2000;

struct Sums {
  std::int64_t xx = 0, xy = 0, yy = 0, xd = 0, yd = 0;
};

// Adds a row. Gradients are doubled.
MOCAP_VECTORIZED
void AddRow(const std::uint8_t* live, const std::uint8_t* expected, const float* variance,
            int stride, int gain, int count, Sums& sums) {
  int xx = 0, xy = 0, yy = 0, xd = 0, yd = 0;
  for (int i = 0; i < count; ++i) {
    const int gx = expected[i + 1] - expected[i - 1];
    const int gy = expected[i + stride] - expected[i - stride];
    const int d = ((gain * live[i] + (1 << (kFractionBits - 1))) >> kFractionBits) - expected[i];
    const int steep = std::abs(gx) + std::abs(gy);
    const int counts = (std::abs(d) <= kExplained + kExplainedGradients * steep ? 1 : 0) &
                       (variance[i] < kUnknownVariance ? 1 : 0);
    xx += counts * gx * gx;
    xy += counts * gx * gy;
    yy += counts * gy * gy;
    xd += counts * gx * d;
    yd += counts * gy * d;
  }
  sums.xx += xx, sums.xy += xy, sums.yy += yy, sums.xd += xd, sums.yd += yd;
}

}  // namespace

std::optional<Displacement> MeasureDisplacement(const HalfPicture& live, float gain,
                                                const ExpectedHalf& expected) {
  MOCAP_CHECK(live.width == expected.mean.width && live.height == expected.mean.height);
  // Gradients in and beside the padding mean nothing.
  const int margin = HalfPicture::kTile + 1;
  Sums sums;
  const auto fixed_gain = static_cast<int>(std::lround(gain * (1 << kFractionBits)));
  for (int y = 1; y < live.height - margin; ++y) {
    const std::size_t i = static_cast<std::size_t>(y) * live.width + 1;
    AddRow(&live.color[1][i], &expected.mean.color[1][i], &expected.variance[i], live.width,
           fixed_gain, live.width - margin - 1, sums);
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
  const Vector2 moved = -2 * normal.inverse() * right;
  return Displacement{static_cast<float>(moved.x()), static_cast<float>(moved.y())};
}

}  // namespace mocap
