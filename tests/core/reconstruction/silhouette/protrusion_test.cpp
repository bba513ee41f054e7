#include "core/reconstruction/silhouette/protrusion.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

// The border of a hand as wide as 60 mm that points along +y and ends at y = 0, 3 m before a camera
// that looks along +x.
Outline OutlineOfHand() {
  const auto ray = [](double y, double z, const Vector3& side_W) {
    const Vector3 direction_W = Vector3(3000, y, z).normalized();
    return GrazingRay{Vector3(-3000, 0, 0), direction_W,
                      (side_W - side_W.dot(direction_W) * direction_W).normalized()};
  };
  Outline outline;
  for (double y = -300; y < 0; y += 20) {
    outline.push_back(ray(y, 30, Vector3::UnitZ()));
    outline.push_back(ray(y, -30, -Vector3::UnitZ()));
  }
  for (double z = -20; z <= 20; z += 20) outline.push_back(ray(0, z, Vector3::UnitY()));
  return outline;
}

std::optional<Protrusion> ProtrusionOf(const Outline& outline, const Vector3& center_W,
                                       double radius_mm) {
  SilhouetteBorder border;
  border.SetOutline(outline);
  return border.ProtrusionOf(center_W, radius_mm);
}

TEST(Protrusion, IsHowFarABallReachesOverTheBorder) {
  const auto protrusion = ProtrusionOf(OutlineOfHand(), Vector3(0, 50, 0), 25);
  ASSERT_TRUE(protrusion);
  EXPECT_NEAR(protrusion->depth_mm, 75, 1);
  EXPECT_GT(protrusion->outward_W.y(), 0.99);
}

TEST(Protrusion, IsOfTheBallAndNotOfItsMiddleOnly) {
  const auto protrusion = ProtrusionOf(OutlineOfHand(), Vector3(0, -10, 0), 25);
  ASSERT_TRUE(protrusion);
  EXPECT_NEAR(protrusion->depth_mm, 15, 1);
}

TEST(Protrusion, IsNoneInside) {
  EXPECT_FALSE(ProtrusionOf(OutlineOfHand(), Vector3(0, -150, 0), 25));
}

TEST(Protrusion, IsNoneWhereTheBorderIsFarOffOrAbsent) {
  EXPECT_FALSE(ProtrusionOf(OutlineOfHand(), Vector3(0, 400, 0), 25));
  EXPECT_FALSE(ProtrusionOf({}, Vector3::Zero(), 25));
}

// As where the picture ends: only the forearm's sides were seen.
TEST(Protrusion, IsNoneWhereTheNearestBorderRunsPast) {
  Outline outline = OutlineOfHand();
  std::erase_if(outline, [](const GrazingRay& ray) { return ray.outward_W.y() > 0.5; });
  EXPECT_FALSE(ProtrusionOf(outline, Vector3(0, 80, 0), 25));
}

}  // namespace
}  // namespace mocap
