#include "core/evidence/ray_motion.h"

#include <gtest/gtest.h>

#include "config/load_config.h"
#include "core/body/stance.h"

namespace mocap {
namespace {

constexpr double kLate_s = 0.015;

class RaysOfWalker : public ::testing::Test {
 protected:
  // Somebody who walks at 1.5 m/s, turns, and swings the arms.
  PoseState PoseAfter(double after_s) const {
    PoseState pose;
    pose.theta = AnglesOf({}, body_.table());
    pose.X_WT.p = Vector3(200, -100, 1000);
    PoseStep rate = PoseStep::Constant(pose.dof(), 1.0);
    rate.head<3>() = Vector3(1500, 300, -100);
    pose.Add(rate * after_s);
    return pose;
  }

  // A ray for each capsule, which grazes the middle of it as the camera saw it.
  Outline RaysSeen(double after_s) const {
    PosedBody seen;
    seen.Set(body_, PoseAfter(after_s));
    Outline outline;
    for (const PosedCapsule& capsule : seen.capsules()) {
      const Vector3 middle_W = CorePlace(capsule, 0.5);
      const Vector3 core_W = capsule.b_W - capsule.a_W;
      const Vector3 outward_W = (middle_W - eye_W_).cross(core_W).normalized();
      const Vector3 grazed_W = middle_W + RadiusAt(capsule, 0.5) * outward_W;
      outline.push_back({eye_W_, (grazed_W - eye_W_).normalized(), outward_W, 0, after_s});
    }
    return outline;
  }

  static std::vector<BoundingEdge> EdgesOf(const Outline& outline, int camera = 0) {
    std::vector<BoundingEdge> edges;
    for (const GrazingRay& ray : outline)
      edges.push_back(
          {{ray.eye_W + 2000 * ray.direction_W, ray.eye_W + 6000 * ray.direction_W, ray.outward_W},
           false,
           ray.rank,
           camera});
    return edges;
  }

  // Mean distance of segments from the body at the moment of the set [mm].
  double MissOf(const std::vector<BoundingEdge>& edges) const {
    PosedBody at_set;
    at_set.Set(body_, PoseAfter(0));
    SegmentMatcher matcher;
    matcher.SetSegments(edges);
    double sum_mm = 0;
    for (const SegmentMatch& match : matcher.Match(at_set.capsules(), 150))
      sum_mm += std::abs(match.distance.outside_mm);
    return sum_mm / static_cast<double>(edges.size());
  }

  BodyModel body_{LoadBodyTable("full"), AverageSizes(1750)};
  Vector3 eye_W_{3500, 1500, 2500};
  Eigen::AlignedBox3d box_W_{Vector3(-1800, -2100, -500), Vector3(2200, 1900, 2500)};
  PersonMotion motion_{body_, [this](double after_s) { return PoseAfter(after_s); }};
};

TEST_F(RaysOfWalker, GrazeTheBodyAtTheMomentOfTheSet) {
  for (const double after_s : {kLate_s, -kLate_s}) {
    std::vector<Outline> borders = {RaysSeen(after_s)};
    std::vector<BoundingEdge> edges = EdgesOf(borders[0]);
    const double before_mm = MissOf(edges);
    EXPECT_GT(before_mm, 10);
    RayMotion().BringToSet(motion_, box_W_, edges, borders);
    EXPECT_LT(MissOf(edges), 0.2 * before_mm);
    EXPECT_LT(MissOf(EdgesOf(borders[0])), 0.2 * before_mm);
  }
}

TEST_F(RaysOfWalker, OfTwoCamerasAtTheSameMomentMoveOnceEach) {
  const Outline seen = RaysSeen(kLate_s);
  std::vector<Outline> borders = {seen, seen}, alone = {seen};
  std::vector<BoundingEdge> edges = EdgesOf(seen), edges_alone = EdgesOf(seen);
  for (const BoundingEdge& edge : EdgesOf(seen, 1)) edges.push_back(edge);
  RayMotion().BringToSet(motion_, box_W_, edges, borders);
  RayMotion().BringToSet(motion_, box_W_, edges_alone, alone);
  for (std::size_t i = 0; i < edges.size(); ++i)
    EXPECT_EQ(edges[i].from_W, edges_alone[i % seen.size()].from_W);
}

TEST_F(RaysOfWalker, KeepEyeAndRightAngles) {
  std::vector<Outline> borders = {RaysSeen(kLate_s)};
  std::vector<BoundingEdge> edges;
  RayMotion().BringToSet(motion_, box_W_, edges, borders);
  for (const GrazingRay& ray : borders[0]) {
    EXPECT_EQ(ray.eye_W, eye_W_);
    EXPECT_NEAR(ray.direction_W.norm(), 1, 1e-12);
    EXPECT_NEAR(ray.outward_W.norm(), 1, 1e-12);
    EXPECT_NEAR(ray.direction_W.dot(ray.outward_W), 0, 1e-12);
  }
}

TEST_F(RaysOfWalker, OfACameraWithATriggerStay) {
  const Outline at_once = RaysSeen(0.0005), late = RaysSeen(kLate_s);
  std::vector<Outline> borders = {at_once, late};
  std::vector<BoundingEdge> edges = EdgesOf(at_once);
  RayMotion().BringToSet(motion_, box_W_, edges, borders);
  for (std::size_t i = 0; i < at_once.size(); ++i) {
    EXPECT_EQ(borders[0][i].direction_W, at_once[i].direction_W);
    EXPECT_EQ(edges[i].from_W, EdgesOf(at_once)[i].from_W);
    EXPECT_NE(borders[1][i].direction_W, late[i].direction_W);
  }
}

TEST_F(RaysOfWalker, ThatGrazeNobodyStay) {
  Outline far = RaysSeen(kLate_s);
  for (GrazingRay& ray : far) ray.direction_W = Vector3::UnitZ();
  std::vector<Outline> borders = {far, {}};
  std::vector<BoundingEdge> edges;
  RayMotion().BringToSet(motion_, box_W_, edges, borders);
  for (std::size_t i = 0; i < far.size(); ++i)
    EXPECT_EQ(borders[0][i].direction_W, far[i].direction_W);
}

}  // namespace
}  // namespace mocap
