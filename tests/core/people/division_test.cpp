#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "core/people/flesh_division.h"
#include "core/people/outline_division.h"
#include "tests/support/seen_body.h"

namespace mocap {
namespace {

constexpr double kReachMm = 250;

class Division : public testing::Test {
 protected:
  PosedPerson At(double x_mm, double stature_mm) const {
    const BodyModel body(table_, AverageSizes(stature_mm));
    PoseState pose;
    pose.X_WT.p = Vector3(x_mm, 0, body.sizes().torso / 2 + body.sizes().thigh + body.sizes().calf);
    pose.theta = AnglesOf(Stance{}, table_);
    PosedPerson person;
    PosePerson(body, pose, kReachMm, 0, person);
    return person;
  }

  RoundStudio::CarvedBody Carve(const std::vector<PosedPerson>& everybody) const {
    std::vector<PosedCapsule> flesh;
    for (const PosedPerson& person : everybody)
      flesh.insert(flesh.end(), person.capsules.begin(), person.capsules.end());
    return RoundStudio().Carve(flesh, 200);
  }

  static int Count(const VoxelGrid& grid) {
    int voxels = 0;
    for (const std::uint64_t word : grid.words()) voxels += std::popcount(word);
    return voxels;
  }

  BodyTable table_ = LoadBodyTable("full");
  FleshDivision flesh_;
  OutlineDivision outlines_;
};

TEST_F(Division, StrangersWhoTouchAreToldApart) {
  const auto seen = Carve({At(-210, 1850), At(210, 1650)});
  VoxelPieces pieces;
  pieces.Find(seen.hull);
  ASSERT_EQ(pieces.sizes().size(), 1u);
  flesh_.Divide(seen.hull, {});
  ASSERT_EQ(flesh_.strangers().size(), 2u);
  const FleshShare& one = flesh_.strangers()[0];
  const FleshShare& other = flesh_.strangers()[1];
  EXPECT_EQ(Count(one.flesh) + Count(other.flesh), Count(seen.hull));
  EXPECT_NEAR(std::abs(one.box_W.center().x() - other.box_W.center().x()), 420, 250);
  EXPECT_GT(one.litres, 40);
  EXPECT_GT(other.litres, 40);
}

TEST_F(Division, GivesEveryVoxelToOneOfThoseWhoTouch) {
  const std::vector<PosedPerson> people = {At(-190, 1800), At(190, 1650)};
  const auto seen = Carve(people);
  flesh_.Divide(seen.hull, people);
  EXPECT_TRUE(flesh_.strangers().empty());
  const FleshShare& left = flesh_.shares()[0];
  const FleshShare& right = flesh_.shares()[1];
  EXPECT_EQ(Count(left.flesh) + Count(right.flesh), Count(seen.hull));
  EXPECT_GT(left.litres, 60);
  EXPECT_GT(right.litres, 45);
  EXPECT_LT(left.box_W.max().x(), 120);
  EXPECT_GT(right.box_W.min().x(), -120);
  // Every share lies in everybody's flesh, voxel by voxel.
  for (const FleshShare* share : {&left, &right}) {
    ASSERT_EQ(share->flesh.size(), share->room.size());
    for (std::size_t i = 0; i < share->flesh.words().size(); ++i)
      EXPECT_EQ(share->flesh.words()[i] & ~share->room.words()[i], 0u);
  }
}

TEST_F(Division, FindsTheFleshOfWhomNobodyKnows) {
  const auto seen = Carve({At(-700, 1800), At(700, 1650)});
  flesh_.Divide(seen.hull, std::vector{At(-700, 1800)});
  ASSERT_EQ(flesh_.strangers().size(), 1u);
  EXPECT_NEAR(flesh_.strangers()[0].box_W.center().x(), 700, 60);
  EXPECT_EQ(Count(flesh_.shares()[0].flesh) + Count(flesh_.strangers()[0].flesh), Count(seen.hull));
}

TEST_F(Division, ASmallPieceGoesToWhoIsBesideIt) {
  const std::vector<PosedPerson> people = {At(0, 1750)};
  std::vector<PosedPerson> with_bag = people;
  const Vector3 bag_W(520, 0, 900);
  with_bag[0].capsules.emplace_back(bag_W, bag_W, 60, 60);
  flesh_.Divide(Carve(with_bag).hull, people);
  EXPECT_TRUE(flesh_.strangers().empty());
  EXPECT_GT(flesh_.shares()[0].box_W.max().x(), 500);
}

TEST_F(Division, WhoseRaysTheOutlinesAre) {
  const std::vector<PosedPerson> people = {At(-500, 1800), At(500, 1650)};
  const auto seen = Carve(people);
  const auto left = Carve({people[0]});
  flesh_.Divide(seen.hull, people);
  outlines_.Divide(seen.outlines, people, flesh_);
  std::size_t rays = 0, owned = 0, wrong = 0;
  for (std::size_t camera = 0; camera < seen.outlines.size(); ++camera) {
    rays += seen.outlines[camera].size();
    for (int i = 0; i < 2; ++i) {
      owned += outlines_.shares()[i].own[camera].size();
      EXPECT_GE(outlines_.shares()[i].near[camera].size(),
                outlines_.shares()[i].own[camera].size());
      // A ray grazes the body whose it is.
      for (const GrazingRay& ray : outlines_.shares()[i].own[camera]) {
        double least_mm = 1e9;
        for (const PosedCapsule& capsule : people[i].capsules)
          least_mm = std::min(
              least_mm,
              std::abs(
                  capsule.DistanceTo(ray.eye_W, ray.eye_W + 9000 * ray.direction_W).outside_mm));
        wrong += least_mm > 30;
      }
    }
  }
  EXPECT_GT(owned, 0.97 * static_cast<double>(rays));
  EXPECT_LT(wrong, 0.02 * static_cast<double>(rays));
  // One camera looks along both.
  EXPECT_GE(outlines_.shares()[0].witnesses, 5);
  EXPECT_GE(outlines_.shares()[1].witnesses, 5);
}

TEST_F(Division, TwoBodiesInOnePlaceHaveNoWitness) {
  const std::vector<PosedPerson> people = {At(0, 1800), At(10, 1790)};
  const auto seen = Carve({people[0]});
  flesh_.Divide(seen.hull, people);
  outlines_.Divide(seen.outlines, people, flesh_);
  EXPECT_LT(std::min(outlines_.shares()[0].witnesses, outlines_.shares()[1].witnesses), 2);
}

}  // namespace
}  // namespace mocap
