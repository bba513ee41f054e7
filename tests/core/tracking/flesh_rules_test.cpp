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

}  // namespace
}  // namespace mocap
