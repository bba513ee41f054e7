#include "drivers/virtual_studio/people/costume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "drivers/virtual_studio/people/person_mesh.h"

namespace mocap::simulation {
namespace {

const Anthropometry kBody = MakeAnthropometry(1750, 7);

struct Figure {
  PersonMesh mesh;
  std::vector<Eigen::Vector3f> p_W;
};

Figure Dressed(const Costume& costume, const BodyPose& pose) {
  Outfit outfit = MakeOutfit(7, {});
  outfit.costume = costume;
  Figure figure{BuildPersonMesh(kBody, outfit, 7), {}};
  std::vector<Eigen::Vector3f> n_W;
  SkinMesh(figure.mesh, PlaceBones(kBody, pose), figure.p_W, n_W);
  return figure;
}

BodyPose Upright() {
  BodyPose pose;
  pose.p_WPelvis.z() = kBody.hip_height_mm();
  return pose;
}

// The farthest vertex along a direction.
double Reach(const Figure& figure, const Eigen::Vector3f& direction) {
  float reach = -1e9F;
  for (const Eigen::Vector3f& p_W : figure.p_W) reach = std::max(reach, p_W.dot(direction));
  return reach;
}

const Eigen::Vector3f kUp = Eigen::Vector3f::UnitZ(), kBack = -Eigen::Vector3f::UnitX();

TEST(Costume, EveryOneIsMadeOfClosedSurfaces) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    for (const char* motion : {"walk", "roll"}) {
      const Costume costume = MakeCostume(seed, motion);
      std::map<std::pair<int, int>, int> edges;
      for (const PersonMesh::Triangle& t : Dressed(costume, Upright()).mesh.triangles)
        for (int k = 0; k < 3; ++k) ++edges[{t.v[k], t.v[(k + 1) % 3]}];
      for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1) << Describe(costume);
        ASSERT_EQ(edges.count({edge.second, edge.first}), 1u) << Describe(costume);
      }
    }
  }
}

TEST(Costume, AllKindsAreDrawn) {
  std::set<Hair> hair;
  std::set<Hat> hats;
  std::set<Drape> drapes;
  int backpacks = 0, bags = 0, crutches = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Costume costume = MakeCostume(seed, "walk");
    hair.insert(costume.hair);
    hats.insert(costume.hat);
    drapes.insert(costume.drape);
    backpacks += costume.backpack_mm > 0;
    bags += costume.has_bag;
    crutches += costume.has_crutches;
  }
  EXPECT_EQ(hair.size(), 6u);
  EXPECT_EQ(hats.size(), 3u);
  EXPECT_EQ(drapes.size(), 4u);
  EXPECT_GT(backpacks, 10);
  EXPECT_GT(bags, 10);
  EXPECT_GT(crutches, 10);
}

TEST(Costume, HairAndHatsAreWhereTheyGrowAndSit) {
  const Figure plain = Dressed({}, Upright());
  const double top_mm = Reach(plain, kUp), back_mm = Reach(plain, kBack);
  EXPECT_GT(Reach(Dressed({.hair = Hair::kAfro, .hair_mm = 80}, Upright()), kUp), top_mm + 40);
  EXPECT_GT(Reach(Dressed({.hair = Hair::kPonytail, .hair_mm = 400}, Upright()), kBack), back_mm);
  EXPECT_NEAR(Reach(Dressed({.hair = Hair::kLong, .hair_mm = 400}, Upright()), kUp), top_mm, 15);
  const double helmet_mm = Reach(Dressed({.hat = Hat::kHelmet}, Upright()), kUp);
  EXPECT_GT(helmet_mm, top_mm + 10);
  EXPECT_LT(helmet_mm, top_mm + 80);
}

TEST(Costume, ABackpackStandsOffByItsDepth) {
  const double plain_mm = Reach(Dressed({}, Upright()), kBack);
  const double packed_mm = Reach(Dressed({.backpack_mm = 200}, Upright()), kBack);
  EXPECT_NEAR(packed_mm - plain_mm, 200, 60);
}

TEST(Costume, ASkirtFollowsTheLegThatIsRaised) {
  const Costume skirt{.drape = Drape::kSkirt, .drape_end = 1, .drape_flare_mm = 20};
  BodyPose step = Upright();
  step.legs[kLeft].flexion = 1;
  // Vertices of the skirt alone: those that the plain figure does not have.
  const std::size_t first = Dressed({}, Upright()).p_W.size();
  const Figure standing = Dressed(skirt, Upright()), stepping = Dressed(skirt, step);
  double left_mm = 0, right_mm = 0;
  for (std::size_t i = first; i < standing.p_W.size(); ++i) {
    const double moved_mm = (stepping.p_W[i] - standing.p_W[i]).norm();
    double& most_mm = standing.p_W[i].y() > 60 ? left_mm : right_mm;
    if (std::abs(standing.p_W[i].y()) > 60) most_mm = std::max(most_mm, moved_mm);
  }
  EXPECT_GT(left_mm, 300);
  EXPECT_LT(right_mm, 100);
}

TEST(Costume, CrutchesReachTheFloorBelowHangingArms) {
  const Figure figure = Dressed({.has_crutches = true}, Upright());
  EXPECT_NEAR(Reach(figure, -kUp), 0, 8);
  const std::size_t first = Dressed({}, Upright()).p_W.size();
  float lowest_mm = 1e9F;
  for (std::size_t i = first; i < figure.p_W.size(); ++i)
    lowest_mm = std::min(lowest_mm, figure.p_W[i].z());
  EXPECT_NEAR(lowest_mm, 0, 8);
}

TEST(Costume, WhoRollsHasAWheelchairAndNobodyWhoSitsOrRunsHasCrutches) {
  EXPECT_EQ(Describe(PlainCostume("roll")), "wheelchair");
  EXPECT_EQ(Describe(PlainCostume("walk")), "plain");
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    EXPECT_TRUE(MakeCostume(seed, "roll").has_wheelchair);
    for (const char* motion : {"roll", "sit", "lie", "run"})
      EXPECT_FALSE(MakeCostume(seed, motion).has_crutches) << motion;
  }
}

TEST(Costume, IsDescribedInWords) {
  EXPECT_EQ(Describe({}), "plain");
  EXPECT_EQ(Describe({.hair = Hair::kAfro, .drape = Drape::kGown, .backpack_mm = 100}),
            "afro, gown, backpack");
  EXPECT_EQ(Describe({.sleeve_slack_mm = 30}), "wide sleeves");
  EXPECT_EQ(Describe({.has_bag = true, .has_crutches = true}), "bag, crutches");
}

TEST(Costume, VariedBuildsKeepTheirStature) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Anthropometry body = kBody;
    VaryBuild(seed, body);
    EXPECT_EQ(body.stature_mm, kBody.stature_mm);
    EXPECT_NEAR(body.shoulder_half_mm / kBody.shoulder_half_mm, 1.025, 0.13);
  }
}

}  // namespace
}  // namespace mocap::simulation
