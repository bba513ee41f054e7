#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "core/people/flesh_division.h"
#include "core/people/outline_division.h"
#include "tests/support/seen_body.h"
#include "tests/support/standing_height.h"

namespace mocap {
namespace {

constexpr double kReachMm = 250;

class Division : public ::testing::Test {
 protected:
  PosedPerson At(double x_mm, double stature_mm) const {
    const BodyModel body(table_, AverageSizes(stature_mm));
    PoseState pose;
    pose.X_WT.p.x() = x_mm;
    pose.theta = AnglesOf(Stance{}, table_);
    PutOnFloor(body, pose);
    PosedPerson person;
    PosePerson(body, pose, kReachMm, person);
    return person;
  }

  RoundStudio::CarvedBody Carve(const std::vector<PosedPerson>& everybody) const {
    std::vector<PosedCapsule> flesh;
    for (const PosedPerson& person : everybody)
      flesh.insert(flesh.end(), person.capsules.begin(), person.capsules.end());
    return RoundStudio().Carve(flesh, 200);
  }

  static bool HasFleshAt(const FleshShare& share, const Vector3& p_W) {
    const VoxelGrid& grid = share.flesh;
    const Eigen::Vector3i cell =
        ((p_W - grid.origin_W()) / grid.voxel_mm()).array().floor().cast<int>();
    return grid.Contains(cell.x(), cell.y(), cell.z()) && grid.Test(cell.x(), cell.y(), cell.z());
  }

  // Rays of a share that pass so near to a place.
  static int RaysPast(const OutlineShare& share, const Vector3& p_W, double aside_mm) {
    int rays = 0;
    for (const Outline& outline : share.own)
      for (const GrazingRay& ray : outline)
        rays += ray.direction_W.cross(p_W - ray.eye_W).norm() < aside_mm;
    return rays;
  }

  static double DistanceTo(const PosedPerson& person, const Vector3& p_W) {
    double least_mm = 1e9;
    for (const PosedCapsule& capsule : person.capsules)
      least_mm = std::min(least_mm, capsule.DistanceTo(p_W).outside_mm);
    return least_mm;
  }

  template <typename Visit>
  static void ForEachVoxel(const VoxelGrid& grid, const Visit& visit) {
    for (int k = 0; k < grid.size().z(); ++k)
      for (int j = 0; j < grid.size().y(); ++j)
        for (int i = 0; i < grid.size().x(); ++i)
          if (grid.Test(i, j, k)) visit(grid.CenterOf(i, j, k));
  }

  // Somebody who is no more than a pillar.
  static PosedPerson PillarAt(double x_mm) {
    PosedPerson person;
    person.capsules.emplace_back(Vector3(x_mm, 0, 100), Vector3(x_mm, 0, 1700), 110, 110);
    const Vector3 reach(110 + kReachMm, 110 + kReachMm, 110 + kReachMm);
    person.box_W = {Vector3(x_mm, 0, 100) - reach, Vector3(x_mm, 0, 1700) + reach};
    person.reach_mm = kReachMm;
    return person;
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

// Of 12 places where two touch, at one the share of one reaches far into the other's: the middles
// of their boxes are 150 mm apart.
TEST_F(Division, StrangersWhoTouchAreToldApart) {
  int touching = 0, apart = 0;
  for (const double x_mm : {-60, -40, -20, 0, 20, 40, 60}) {
    const auto seen = Carve({At(x_mm - 200, 1850), At(x_mm + 200, 1650)});
    VoxelPieces pieces;
    pieces.Find(seen.hull);
    if (pieces.sizes().size() != 1) continue;
    ++touching;
    flesh_.Divide(seen.hull, {});
    ASSERT_EQ(flesh_.strangers().size(), 2u);
    const FleshShare& one = flesh_.strangers()[0];
    const FleshShare& other = flesh_.strangers()[1];
    EXPECT_EQ(Count(one.flesh) + Count(other.flesh), Count(seen.hull));
    apart += std::abs(std::abs(one.box_W.center().x() - other.box_W.center().x()) - 420) < 250;
    for (const FleshShare& share : flesh_.strangers())
      EXPECT_GT(Count(share.flesh) * std::pow(share.flesh.voxel_mm() / 100, 3), 40) << "litres";
  }
  EXPECT_GE(touching, 6);
  EXPECT_GE(apart, touching - 1);
}

TEST_F(Division, GivesEveryVoxelThatABodyExplainsToOneOfThoseWhoTouch) {
  const std::vector<PosedPerson> people = {At(-190, 1800), At(190, 1650)};
  const auto seen = Carve(people);
  flesh_.Divide(seen.hull, people);
  EXPECT_TRUE(flesh_.strangers().empty());
  int wrong = 0, shared = 0;
  ForEachVoxel(seen.hull, [&](const Vector3& p_W) {
    const bool left = HasFleshAt(flesh_.shares()[0], p_W);
    const bool right = HasFleshAt(flesh_.shares()[1], p_W);
    const double left_mm = DistanceTo(people[0], p_W), right_mm = DistanceTo(people[1], p_W);
    const bool is_explained = std::min(left_mm, right_mm) <= kExplainsMm;
    shared += left && right;
    wrong += !left && !right;
    wrong += is_explained && left && right;
    wrong += is_explained && left != (left_mm < right_mm);
  });
  EXPECT_EQ(wrong, 0);
  EXPECT_LT(shared, Count(seen.hull) / 5);
  // Every share lies in everybody's flesh, voxel by voxel.
  for (const FleshShare& share : flesh_.shares()) {
    ASSERT_EQ(share.flesh.size(), share.room.size());
    for (std::size_t i = 0; i < share.flesh.words().size(); ++i)
      EXPECT_EQ(share.flesh.words()[i] & ~share.room.words()[i], 0u);
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
  const Vector3 bag_W(500, 0, 900);
  with_bag[0].capsules.emplace_back(bag_W, bag_W, 75, 75);
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
  EXPECT_GE(outlines_.shares()[0].cameras, 5);
  EXPECT_GE(outlines_.shares()[1].cameras, 5);
}

TEST_F(Division, NoCameraShowsTwoBodiesInOnePlaceApart) {
  const std::vector<PosedPerson> people = {At(0, 1800), At(10, 1790)};
  const auto seen = Carve({people[0]});
  flesh_.Divide(seen.hull, people);
  outlines_.Divide(seen.outlines, people, flesh_);
  EXPECT_LT(std::min(outlines_.shares()[0].cameras, outlines_.shares()[1].cameras), 2);
}

TEST_F(Division, WhatNoBodyExplainsIsForAllWhoMayHaveLostIt) {
  const std::vector<PosedPerson> people = {PillarAt(-310), PillarAt(310)};
  std::vector<PosedPerson> with_hand = people;
  const Vector3 hand_W(0, 0, 1300);
  with_hand[0].capsules.emplace_back(hand_W, hand_W, 60, 60);
  const auto seen = Carve(with_hand);
  flesh_.Divide(seen.hull, people);
  outlines_.Divide(seen.outlines, people, flesh_);
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(HasFleshAt(flesh_.shares()[i], hand_W)) << i;
    EXPECT_GT(RaysPast(outlines_.shares()[i], hand_W, 75), 10) << i;
  }
  // What a body explains is its own.
  const Vector3 chest_W(-310, 0, 1300);
  EXPECT_TRUE(HasFleshAt(flesh_.shares()[0], chest_W));
  EXPECT_FALSE(HasFleshAt(flesh_.shares()[1], chest_W));
}

TEST_F(Division, StrangeFleshTakesNoCameraFromAKnownPerson) {
  const std::vector<PosedPerson> people = {At(0, 1750)};
  std::vector<PosedPerson> with_phantom = people;
  const std::vector<Vector3> around_W = {
      {-700, -500, 900}, {-700, 600, 900}, {700, 600, 900}, {700, -500, 900}};
  for (std::size_t i = 0; i + 1 < around_W.size(); ++i)
    with_phantom[0].capsules.emplace_back(around_W[i], around_W[i + 1], 110, 110);
  const auto seen = Carve(with_phantom);
  flesh_.Divide(seen.hull, people);
  ASSERT_FALSE(flesh_.strangers().empty());
  ASSERT_TRUE(flesh_.strangers()[0].box_W.contains(Vector3(0, 0, 900)));
  outlines_.Divide(seen.outlines, people, flesh_);
  EXPECT_GE(outlines_.shares()[0].cameras, 5);
}

}  // namespace
}  // namespace mocap
