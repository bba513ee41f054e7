#include "core/mikic2003/part_widths.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/mikic2003/limbs.h"

namespace mocap::mikic2003 {
namespace {

// Fewer voxels have no shape.
constexpr std::size_t kFewestVoxels = 8;

std::optional<double> WidthOf(const VoxelCloud& cloud, const Labels& labels, BodyPart part) {
  const VoxelIndices voxels = VoxelsLabeled(labels, LabelOf(part));
  if (voxels.size() < kFewestVoxels) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Matrix3> axes(CovarianceOf(cloud, voxels),
                                                    Eigen::EigenvaluesOnly);
  const Vector3 variances = axes.eigenvalues().cwiseMax(0);
  // A disc of width w has the variance w² / 16 along both axes.
  return 4 * std::sqrt((variances[0] + variances[1]) / 2);
}

}  // namespace

void MeasureLimbWidths(const VoxelCloud& cloud, const Labels& labels, BodySizes& sizes) {
  const auto measure = [&](BodyPart left, BodyPart right, double& width_mm) {
    if (const auto mean = MeanOf(WidthOf(cloud, labels, left), WidthOf(cloud, labels, right))) {
      width_mm = *mean;
    }
  };
  for (int limb = 0; limb < kLimbCount; limb += 2) {
    const Limb &left = kLimbs[limb], &right = kLimbs[limb + 1];
    measure(left.upper, right.upper, sizes.*left.upper_width);
    measure(left.lower, right.lower, sizes.*left.lower_width);
  }
}

}  // namespace mocap::mikic2003
