#include "core/hypotheses/size_refiner.h"

#include <gtest/gtest.h>

#include <cmath>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "core/hypotheses/hypothesis.h"
#include "tests/support/seen_body.h"
#include "tests/support/standing_height.h"

namespace mocap {
namespace {

BodySizes SizesOf(double stature_mm, double build) {
  BodySizes sizes = AverageSizes(stature_mm);
  for (const SizeMember width : kStoutWidths) sizes.*width *= build;
  return sizes;
}

PoseState Upright(const BodyModel& body) {
  PoseState pose;
  pose.theta = AnglesOf({}, body.table());
  pose.X_WT.R.setIdentity();
  pose.X_WT.p = Vector3(0, 0, StandingHeight(body.sizes()));
  return pose;
}

// Whose stature was taken for 50 mm less, by a body of the right build.
double StatureMeasured(double stature_mm, double build) {
  const BodyTable table = LoadBodyTable("full");
  const BodyModel person(table, SizesOf(stature_mm, build));
  const BodyModel found(table, SizesOf(stature_mm - 50, build));
  const PoseState pose = Upright(person);
  const RoundStudio studio;
  const Evidence evidence = studio.Show(person, pose);
  Objective objective;
  objective.SetEvidence(evidence);
  Hypothesis hypothesis(found, pose, true);
  hypothesis.Fit(objective);
  hypothesis.MeasureSizes(objective);
  return hypothesis.body.sizes().Stature();
}

TEST(SizeRefiner, WithoutFramesKeepsTheBodyThatWasFound) {
  const BodyModel body(LoadBodyTable("full"), SizesOf(1700, 1.3));
  EXPECT_NEAR(SizeRefiner(body).Sizes().Stature(), 1700, 1e-6);
  EXPECT_NEAR(SizeRefiner(body).Sizes().thigh_width, body.sizes().thigh_width, 1e-6);
}

TEST(SizeRefiner, MeasuresTheStatureOfWhoIsLeanAndOfWhoIsStout) {
  EXPECT_NEAR(StatureMeasured(1750, 1), 1750, 25);
  EXPECT_NEAR(StatureMeasured(1750, 1.4), 1750, 25);
}

TEST(SizeRefiner, MeasuresTheDrapeOfWhoWearsOneAndGivesItToNobodyElse) {
  const BodyTable table = LoadBodyTable("full");
  BodySizes skirt = AverageSizes(1750);
  skirt.drape_hip = 40, skirt.drape_knee = 130, skirt.drape_calf = 60;
  BodySizes narrow = skirt;
  narrow.drape_knee = 70;
  const BodyModel person(table, skirt), found(table, narrow);
  const PoseState pose = Upright(person);
  const RoundStudio studio;
  const Evidence evidence = studio.Show(person, pose);
  const auto measured_by = [&](const BodyModel& body) {
    Objective objective;
    objective.SetEvidence(evidence);
    SizeRefiner refiner(body);
    refiner.Add(body, objective, pose);
    return refiner.Sizes();
  };
  EXPECT_NEAR(measured_by(found).drape_knee, 130, 25);
  EXPECT_FALSE(measured_by(BodyModel(table, AverageSizes(1750))).IsDraped());
}

TEST(SizeRefiner, SizesApproachTheTruthOverTheFrames) {
  const BodyModel start(LoadBodyTable("full"), AverageSizes(1750));
  BodySizes person = start.sizes();
  person.thigh_width *= 0.88;
  person.torso_depth *= 0.92;
  const BodyModel truth(start.table(), person);
  const RoundStudio studio;
  Objective objective;
  Hypothesis hypothesis(start, Upright(start), true);
  for (int frame = 0; frame < 9; ++frame) {
    const double swing = 25 * std::sin(0.8 * frame);
    PoseState pose = Upright(truth);
    pose.theta =
        AnglesOf({.arm_l = {.forward = swing}, .leg_l = {.hip = -swing}, .leg_r = {.hip = swing}},
                 truth.table());
    const Evidence evidence = studio.Show(truth, pose);
    objective.SetEvidence(evidence);
    hypothesis.Jump(objective, pose);
    hypothesis.RefineSizes(objective);
  }
  EXPECT_EQ(hypothesis.sizes->frames(), 9);
  const BodySizes& found = hypothesis.body.sizes();
  EXPECT_NEAR(found.thigh_width, person.thigh_width,
              0.6 * (start.sizes().thigh_width - person.thigh_width));
  EXPECT_NEAR(found.torso_depth, person.torso_depth,
              0.8 * (start.sizes().torso_depth - person.torso_depth));
}

// Half of the cameras see wide trousers, the others the legs.
TEST(SizeRefiner, ClothCountsLessThanTheLimbWithin) {
  const BodyTable table = LoadBodyTable("full");
  const BodySizes legs = AverageSizes(1750);
  BodySizes trousers = legs;
  trousers.thigh_width *= 1.4;
  trousers.calf_width *= 1.4;
  BodySizes middle = legs;
  middle.thigh_width *= 1.2;
  middle.calf_width *= 1.2;
  const BodyModel found(table, middle);
  const PoseState pose = Upright(found);
  const RoundStudio studio;
  Evidence evidence = studio.Show(BodyModel(table, legs), pose);
  const Evidence wide = studio.Show(BodyModel(table, trousers), pose);
  for (std::size_t i = 0; i < evidence.borders.size(); i += 2)
    evidence.borders[i] = wide.borders[i];
  FindBoundingEdges(wide.cloud, evidence.borders, wide.cloud.box_W(), evidence.edges);
  Objective objective;
  objective.SetEvidence(evidence);
  Hypothesis hypothesis(found, pose, true);
  hypothesis.Fit(objective);
  hypothesis.MeasureSizes(objective);
  EXPECT_LT(hypothesis.body.sizes().thigh_width, 0.97 * middle.thigh_width);
  EXPECT_LT(hypothesis.body.sizes().calf_width, 0.97 * middle.calf_width);
}

}  // namespace
}  // namespace mocap
