#include "core/geometry.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

TEST(Geometry, LogIsTheInverseOfExp) {
  for (const double angle : {0.0, 1e-8, 0.3, 1.0, 3.1}) {
    const Vector3 w = angle * Vector3(0.36, -0.48, 0.8);
    EXPECT_NEAR((LogRotation(ExpRotation(w)) - w).norm(), 0, 1e-12);
  }
}

}  // namespace
}  // namespace mocap
