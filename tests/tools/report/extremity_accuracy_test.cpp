#include "tools/report/extremity_accuracy.h"

#include <gtest/gtest.h>

#include "config/load_config.h"
#include "core/degrees.h"
#include "tests/support/moving_body.h"
#include "tools/report/extremity_text.h"

namespace mocap {
namespace {

constexpr std::int64_t kExtremityPeriod_ns = 33'333'333;

/// A body that stands still, and a truth that is the same.
class ExtremityAccuracyTest : public ::testing::Test {
 protected:
  static constexpr int kSets = 30;

  ExtremityAccuracyTest()
      : body_(LoadBodyTable("full"), AverageSizes(1750)), result_(StandingStill(body_)) {
    const PoseRow& row = result_.poses.front();
    for (int i = 0; i < kSets; ++i) {
      truth_.frames.push_back(
          {.timestamp_ns = i * kExtremityPeriod_ns, .points_W = ScoredPointsOf(row.points_W)});
      TrueExtremities& truth = truth_.extremities.emplace_back();
      truth.points_W = row.further_W;
      truth.contacts.setOnes();
      truth.rotations.setZero();
      // Hands of arms that are held out, against those that hang.
      truth.rotations(0, 1) = EIGEN_PI / 2;
      truth.rotations(0, 2) = -EIGEN_PI / 2;
    }
  }

  static Result StandingStill(const BodyModel& body) {
    CaptureResult capture;
    capture.state = CaptureState::kTracking;
    capture.pose.theta = JointAngles::Zero(body.joint_count());
    capture.pose.X_WT.p = {0, 0, 1200};
    const Posture posture = body.PostureAt(capture.pose);
    capture.points_W = body.PointsAt(posture);
    capture.further_W = body.FurtherPointsAt(posture);
    capture.contacts.setOnes();
    Result result{RecordOf(body), {}};
    for (int i = 0; i < kSets; ++i)
      result.poses.push_back(PoseRowOf(i, i * kExtremityPeriod_ns, capture, body));
    return result;
  }

  FurtherPoints LeftAnkleFlexed(double rad) const {
    const int ankle = body_.CarrierOf(Point::kHeelL) - 1;
    EXPECT_EQ(body_.table().joints[static_cast<std::size_t>(ankle)].name, "ankle_l_y");
    PoseState pose;
    pose.theta = JointAngles::Zero(body_.joint_count());
    pose.theta[ankle] = rad;
    pose.X_WT.p = {0, 0, 1200};
    return body_.FurtherPointsAt(body_.PostureAt(pose));
  }

  ExtremityAccuracy Measure() const {
    std::vector<ScoredFrame> output;
    for (const PoseRow& row : result_.poses)
      output.push_back({row.timestamp_ns, true, ScoredPointsOf(row.points_W)});
    return MeasureExtremities(result_, truth_, MeasureAccuracy(truth_.frames, output).frames);
  }

  static double MeanIn(const std::vector<FigureErrors>& figures, std::string_view name) {
    const auto found = std::ranges::find(figures, name, &FigureErrors::name);
    EXPECT_NE(found, figures.end()) << name;
    return found == figures.end() ? -1 : found->mean;
  }

  const BodyModel body_;
  Result result_;
  TakeTruth truth_;
};

TEST_F(ExtremityAccuracyTest, WhatIsTrueHasNoErrors) {
  const ExtremityAccuracy accuracy = Measure();
  EXPECT_EQ(accuracy.points_mm.size(), 14u);
  EXPECT_EQ(accuracy.angles_deg.size(), 9u);
  for (const FigureErrors& one : accuracy.points_mm) EXPECT_NEAR(one.mean, 0, 1e-9) << one.name;
  for (const FigureErrors& one : accuracy.angles_deg) EXPECT_NEAR(one.mean, 0, 1e-5) << one.name;
  EXPECT_EQ(accuracy.contacts[0].F1(), 1);
  EXPECT_EQ(accuracy.skating[0].stances, 2);
  EXPECT_NEAR(accuracy.skating[0].stance_mean_mm, 0, 1e-9);
}

TEST_F(ExtremityAccuracyTest, PointsThatTheTruthLacksAreLeftOut) {
  for (TrueExtremities& truth : truth_.extremities) {
    truth.points_W.leftCols<2>().setConstant(std::nan(""));
    truth.rotations.setConstant(std::nan(""));
    truth.contacts.setConstant(std::nan(""));
  }
  const ExtremityAccuracy accuracy = Measure();
  EXPECT_EQ(accuracy.points_mm.size(), 12u);
  EXPECT_EQ(accuracy.points_mm.front().name, "wrist_l");
  EXPECT_EQ(accuracy.angles_deg.size(), 2u);
  EXPECT_TRUE(accuracy.contacts[0].IsEmpty());
  truth_.extremities.clear();
  EXPECT_TRUE(Measure().IsEmpty());
}

TEST_F(ExtremityAccuracyTest, AHeadThatLooksElsewhereIsOffInThatAngle) {
  for (TrueExtremities& truth : truth_.extremities)
    truth.rotations.col(0) = Vector3(0, 0, 10 / kDegreesPerRad);
  const ExtremityAccuracy accuracy = Measure();
  EXPECT_NEAR(MeanIn(accuracy.angles_deg, "head_yaw"), 10, 1e-6);
  EXPECT_NEAR(MeanIn(accuracy.angles_deg, "head_pitch"), 0, 1e-6);
  EXPECT_NEAR(MeanIn(accuracy.angles_deg, "hand_turn_l"), 0, 1e-5);
}

TEST_F(ExtremityAccuracyTest, ABodyWithoutHandsAndATurningHeadHasNoAnglesOfThem) {
  result_ = StandingStill(BodyModel(LoadBodyTable("mikic2003"), AverageSizes(1750)));
  for (const FigureErrors& one : Measure().angles_deg)
    EXPECT_FALSE(one.name.starts_with("hand_") || one.name.starts_with("head_")) << one.name;
  // A body of earlier versions: it turns its hands, but its results do not have their points.
  result_ = StandingStill(body_);
  testing::MakeOfEarlierFull(result_);
  EXPECT_TRUE(Measure().angles_deg.empty());
}

TEST_F(ExtremityAccuracyTest, AHandThatAFrameLacksIsLeftOutOfIt) {
  for (int i = 0; i < kSets; ++i) {
    if (i >= 10) truth_.extremities[i].rotations(2, 0) = 0.5;
    if (i >= 10) testing::LoseDetails(result_.poses[i]);
    if (i >= 10) truth_.extremities[i].rotations(2, 1) = 0.5;
  }
  const ExtremityAccuracy accuracy = Measure();
  EXPECT_NEAR(MeanIn(accuracy.angles_deg, "hand_turn_l"), 0, 1e-5);
  EXPECT_GT(MeanIn(accuracy.angles_deg, "head_yaw"), 10);
}

TEST_F(ExtremityAccuracyTest, AFlexedAnkleIsOffByItsFlexion) {
  for (PoseRow& row : result_.poses) row.further_W = LeftAnkleFlexed(0.2);
  // The ankle's axis is oblique.
  EXPECT_NEAR(MeanIn(Measure().angles_deg, "ankle_flexion_l"), 0.2 * kDegreesPerRad, 0.4);
  EXPECT_NEAR(MeanIn(Measure().angles_deg, "ankle_flexion_r"), 0, 1e-6);
}

TEST_F(ExtremityAccuracyTest, WithoutTrueHeelsFlexionHasNoZero) {
  for (TrueExtremities& truth : truth_.extremities)
    FurtherOf(truth.points_W, Point::kHeelL).setConstant(std::nan(""));
  for (PoseRow& row : result_.poses) row.further_W = LeftAnkleFlexed(0.2);
  EXPECT_NEAR(MeanIn(Measure().angles_deg, "ankle_flexion_l"), 0, 1e-6);
  for (int i = 0; i < kSets; i += 2) result_.poses[i].further_W = LeftAnkleFlexed(0);
  EXPECT_NEAR(MeanIn(Measure().angles_deg, "ankle_flexion_l"), 0.1 * kDegreesPerRad, 0.4);
}

TEST_F(ExtremityAccuracyTest, AContactMayBeAFrameOffAndNoMore) {
  for (int i = 0; i < kSets; ++i) truth_.extremities[i].contacts[0] = i >= 15;
  const auto found_from = [&](int first) {
    for (int i = 0; i < kSets; ++i) result_.poses[i].contacts[0] = i >= first ? 0.9 : 0.1;
    return Measure().contacts[0];
  };
  EXPECT_EQ(found_from(14).F1(), 1);
  EXPECT_EQ(found_from(16).F1(), 1);
  EXPECT_EQ(found_from(13).false_alarms, 1);
  EXPECT_EQ(found_from(17).misses, 1);
}

TEST_F(ExtremityAccuracyTest, AStandingFootThatSlidesSkates) {
  for (int i = 0; i < kSets; ++i)
    for (const Point point : {Point::kHeelL, Point::kHeelR})
      FurtherOf(result_.poses[i].further_W, point).y() += 2.0 * i;
  const ExtremityAccuracy accuracy = Measure();
  EXPECT_NEAR(accuracy.skating[0].frame_p95_mm, 2, 1e-9);
  EXPECT_NEAR(accuracy.skating[0].stance_mean_mm, 2.0 * (kSets - 1), 1e-9);
  EXPECT_NEAR(accuracy.true_skating[0].stance_mean_mm, 0, 1e-9);
  EXPECT_NEAR(accuracy.skating[1].stance_mean_mm, 0, 1e-9);
}

TEST_F(ExtremityAccuracyTest, IsToldInTextAndJson) {
  const Json json = ExtremityJson(Measure());
  EXPECT_EQ(json["points_mm"]["wrist_l"]["mean"], 0);
  EXPECT_EQ(json["angles_deg"]["head_yaw"]["p95"], 0);
  EXPECT_EQ(json["contacts"]["toe"]["f1"], 1);
  EXPECT_EQ(json["skating_mm"]["heel"]["stances"], 2);
  const std::string text = ExtremityText(Measure());
  for (const char* told : {"knuckles_r", "ankle_flexion_l", "heel", "1.000"})
    EXPECT_NE(text.find(told), std::string::npos) << text;
  EXPECT_EQ(ExtremityText({}), "");
}

TEST_F(ExtremityAccuracyTest, TakesWithoutAFigureDoNotCountForIt) {
  ExtremityAccuracy one, other;
  one.points_mm = {{"wrist_l", 10, 20}};
  other.points_mm = {{"wrist_l", 20, 40}, {"heel_l", 6, 8}};
  one.contacts[0] = {.hits = 9, .false_alarms = 1, .misses = 1};
  const ExtremityAccuracy mean = MeanOf(std::vector{one, other, ExtremityAccuracy()});
  EXPECT_EQ(MeanIn(mean.points_mm, "wrist_l"), 15);
  EXPECT_EQ(MeanIn(mean.points_mm, "heel_l"), 6);
  EXPECT_EQ(mean.contacts[0].F1(), 0.9);
}

}  // namespace
}  // namespace mocap
