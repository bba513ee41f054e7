#include "drivers/virtual_studio/people/person_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace mocap::simulation {
namespace {

struct Skin {
  Anthropometry body;
  PersonMesh mesh;
  std::vector<Eigen::Vector3f> p_W, n_W;
};

Skin StandingSkin(double stature_mm, std::uint64_t seed) {
  Skin skin;
  skin.body = MakeAnthropometry(stature_mm, seed);
  skin.mesh = BuildPersonMesh(skin.body, MakeOutfit(seed, {}), seed);
  BodyPose upright;
  upright.p_WPelvis.z() = skin.body.hip_height_mm();
  SkinMesh(skin.mesh, PlaceBones(skin.body, upright), skin.p_W, skin.n_W);
  return skin;
}

TEST(PersonMesh, StandsOnItsSolesAsTallAsItsStature) {
  for (const double stature_mm : {1100.0, 1500.0, 1750.0, 2000.0}) {
    const Skin skin = StandingSkin(stature_mm, 7);
    const auto [low, high] =
        std::minmax_element(skin.p_W.begin(), skin.p_W.end(),
                            [](const auto& a, const auto& b) { return a.z() < b.z(); });
    EXPECT_NEAR(low->z(), 0, 1);
    EXPECT_NEAR(high->z(), stature_mm, 1);
  }
}

TEST(PersonMesh, EveryPartIsAClosedSurfaceTurnedOutward) {
  const Skin skin = StandingSkin(1750, 7);
  std::map<std::pair<int, int>, int> edges;
  double volume_mm3 = 0;
  for (const PersonMesh::Triangle& t : skin.mesh.triangles) {
    for (int k = 0; k < 3; ++k) ++edges[{t.v[k], t.v[(k + 1) % 3]}];
    volume_mm3 += skin.p_W[t.v[0]].cast<double>().dot(
                      skin.p_W[t.v[1]].cast<double>().cross(skin.p_W[t.v[2]].cast<double>())) /
                  6;
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  // Parts overlap a little; people weigh about a litre a kilogram.
  EXPECT_GT(volume_mm3 * 1e-6, 50);
  EXPECT_LT(volume_mm3 * 1e-6, 130);
}

TEST(PersonMesh, WeightsAddUpToOne) {
  for (const PersonMesh::Vertex& v : StandingSkin(1750, 7).mesh.vertices)
    EXPECT_NEAR(v.weights[0] + v.weights[1] + v.weights[2], 1, 1e-5);
}

TEST(PersonMesh, FollowsItsBones) {
  Skin skin = StandingSkin(1750, 7);
  BodyPose pose;
  pose.p_WPelvis = {300, 400, 900};
  pose.arms[kLeft].flexion = 1.2;
  const BonePoses bones = PlaceBones(skin.body, pose);
  SkinMesh(skin.mesh, bones, skin.p_W, skin.n_W);
  const TruePoints points = PointsOf(skin.body, bones);
  const Vector3 tip = points[static_cast<int>(TruthPoint::kFingertipsL)];
  double nearest = 1e9;
  for (const Eigen::Vector3f& p : skin.p_W)
    nearest = std::min(nearest, (p.cast<double>() - tip).norm());
  EXPECT_LT(nearest, 15);
}

TEST(PersonMesh, HeavyPeopleAreWiderThanSlimOnes) {
  const auto depth = [](double girth) {
    Anthropometry body = MakeAnthropometry(1750, 7);
    body.girth = girth;
    const PersonMesh mesh = BuildPersonMesh(body, MakeOutfit(7, {}), 7);
    float front = 0;
    for (const PersonMesh::Vertex& v : mesh.vertices)
      if (v.bones[0] == kLumbar) front = std::max(front, v.p_rest.x());
    return front;
  };
  EXPECT_GT(depth(1), depth(-1) + 30);
}

}  // namespace
}  // namespace mocap::simulation
