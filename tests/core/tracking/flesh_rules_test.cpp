#include "core/tracking/flesh_rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mocap {
namespace {

TEST(Flesh, IsNearestWhereNoOtherPlaceIsNearer) {
  std::vector<Contact> contacts;
  for (int i = 0; i < 37; ++i) {
    const Vector3 place(100 * std::sin(3.0 * i), 100 * std::cos(5.0 * i), 10 * i);
    contacts.push_back({place, place, Vector3::UnitX(), i % 5 == 0});
  }
  PlaceColumns places;
  places.Set(contacts);
  EXPECT_EQ(places.size(), 29);
  for (int i = 0; i < 50; ++i) {
    const Vector3 p(120 * std::cos(7.0 * i), 120 * std::sin(2.0 * i), 8 * i);
    double least = std::numeric_limits<double>::infinity();
    for (const Contact& contact : contacts)
      if (!contact.is_edge) least = std::min(least, (contact.from_W - p).norm());
    EXPECT_NEAR((places.NearestTo(p) - p).norm(), least, 1e-9);
  }
}

TEST(Flesh, IsNotToBeFoundWhereNoneWasSeen) {
  EXPECT_FALSE(WayToFlesh(VoxelCloud(), PlaceColumns(), Vector3::Zero()));
}

TEST(Flesh, IsNotWhereOnlyClothIs) {
  const Capsule leg{
      .a_T = Vector3(0, 0, 400), .b_T = Vector3(0, 0, 0), .radius_a_mm = 60, .radius_b_mm = 40};
  Capsule draped = leg;
  draped.cloth_a_mm = 80, draped.cloth_b_mm = 120;
  const RigidTransform beside{Matrix3::Identity(), Vector3(45, 0, 0)};
  const PosedCapsule bare(leg, {}), other(leg, beside);
  const PosedCapsule in_skirt(draped, {}), other_in_skirt(draped, beside);
  for (const double share : kCoreShares) {
    const Vector3 p_W = CorePlace(bare, share);
    EXPECT_DOUBLE_EQ(RadiusAt(in_skirt, share), RadiusAt(bare, share));
    EXPECT_NEAR(in_skirt.DistanceTo(p_W).outside_mm,
                bare.DistanceTo(p_W).outside_mm - draped.cloth_a_mm -
                    share * (draped.cloth_b_mm - draped.cloth_a_mm),
                1e-9);
    EXPECT_NEAR(OverlapDepth(in_skirt, other_in_skirt, other_in_skirt.DistanceTo(p_W)),
                OverlapDepth(bare, other, other.DistanceTo(p_W)), 1e-9);
  }
}

}  // namespace
}  // namespace mocap
