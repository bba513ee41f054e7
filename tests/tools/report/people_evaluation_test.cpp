#include "tools/report/people_evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/report_data.h"
#include "tools/report/people_report.h"
#include "tools/report/people_text.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kPeriodNs = 40'000'000;

BodyPoints PointsAt(double x_mm) {
  BodyPoints points = BodyPoints::Zero();
  for (int i = 0; i < kPointCount; ++i) points.col(i) = Vector3(x_mm, 20 * i, 1000 + 30 * i);
  return points;
}

TruePerson Standing(const std::string& name, int from, int to, double x_mm) {
  TruePerson person{name, {}, {}};
  person.truth.stature_mm = 1700;
  for (int frame = from; frame < to; ++frame) {
    person.truth.frames.push_back({frame * kPeriodNs, true, ScoredPointsOf(PointsAt(x_mm))});
    person.truth.numbers.push_back(frame);
    person.covered.push_back(true);
  }
  return person;
}

Result TrackedAt(int from, int to, double x_mm) {
  Result result;
  result.body.model = "full";
  for (int frame = from; frame < to; ++frame) {
    PoseRow& row = result.poses.emplace_back();
    row.frame = frame;
    row.timestamp_ns = frame * kPeriodNs;
    row.state = CaptureState::kTracking;
    row.has_pose = true;
    row.points_W = PointsAt(x_mm);
  }
  return result;
}

Result operator+(Result first, const Result& then) {
  first.poses.insert(first.poses.end(), then.poses.begin(), then.poses.end());
  return first;
}

TEST(EvaluatePeople, EachIsHeldAgainstWhomHeIs) {
  const PeopleEvaluation evaluation =
      EvaluatePeople({{"person-1", TrackedAt(0, 10, 2010)}, {"person-2", TrackedAt(2, 10, 30)}},
                     {Standing("anna", 0, 10, 0), Standing("bert", 0, 10, 2000)});
  ASSERT_EQ(evaluation.people.size(), 2u);
  EXPECT_EQ(evaluation.people[0].true_person, 1);
  EXPECT_EQ(evaluation.people[1].true_person, 0);
  EXPECT_NEAR(evaluation.people[0].evaluation.accuracy->distance_mm.mean, 10, 1e-9);
  EXPECT_NEAR(evaluation.people[1].evaluation.accuracy->distance_mm.mean, 30, 1e-9);
  EXPECT_EQ(evaluation.followed[0].found, 8);
  EXPECT_EQ(evaluation.sum.found, 18);
  EXPECT_NEAR(evaluation.sum.mean_mm, (10 * 10 + 8 * 30) / 18.0, 1e-9);
  EXPECT_EQ(evaluation.sum.switches, 0);
  EXPECT_EQ(evaluation.phantom_frames, 0);
}

TEST(EvaluatePeople, WhoeverGoesOnUnderAnotherNumberIsASwitch) {
  const PeopleEvaluation evaluation =
      EvaluatePeople({{"person-1", TrackedAt(0, 4, 0)}, {"person-2", TrackedAt(6, 10, 0)}},
                     {Standing("anna", 0, 10, 0)});
  EXPECT_EQ(evaluation.followed[0].switches, 1);
  EXPECT_EQ(evaluation.followed[0].found, 8);
}

TEST(EvaluatePeople, TwoWhoAreTakenForOneAnotherAreTwoSwitches) {
  const PeopleEvaluation evaluation =
      EvaluatePeople({{"person-1", TrackedAt(0, 5, 0) + TrackedAt(5, 10, 2000)},
                      {"person-2", TrackedAt(0, 5, 2000) + TrackedAt(5, 10, 0)}},
                     {Standing("anna", 0, 10, 0), Standing("bert", 0, 10, 2000)});
  EXPECT_EQ(evaluation.sum.switches, 2);
  EXPECT_NEAR(evaluation.people[0].evaluation.accuracy->distance_mm.mean, 0, 1e-9)
      << "he was somebody all the time";
}

TEST(EvaluatePeople, FramesWhereNobodyIsArePhantoms) {
  const PeopleEvaluation evaluation =
      EvaluatePeople({{"person-1", TrackedAt(0, 10, 0)}, {"person-2", TrackedAt(3, 8, 5000)}},
                     {Standing("anna", 0, 6, 0)});
  EXPECT_EQ(evaluation.people[0].phantom_frames, 4) << "anna has left";
  EXPECT_EQ(evaluation.people[1].phantom_frames, 5);
  EXPECT_EQ(evaluation.people[1].true_person, -1);
  EXPECT_FALSE(evaluation.people[1].evaluation.accuracy);
  EXPECT_EQ(evaluation.phantom_frames, 9);
  EXPECT_EQ(evaluation.duplicate_frames, 0);
}

TEST(EvaluatePeople, ASecondFollowerOfSomebodyIsADuplicateAndNoPhantom) {
  const PeopleEvaluation evaluation =
      EvaluatePeople({{"person-1", TrackedAt(0, 10, 0)}, {"person-2", TrackedAt(3, 8, 100)}},
                     {Standing("anna", 0, 10, 0)});
  EXPECT_EQ(evaluation.people[0].duplicate_frames, 0);
  EXPECT_EQ(evaluation.people[1].duplicate_frames, 5);
  EXPECT_EQ(evaluation.duplicate_frames, 5);
  EXPECT_EQ(evaluation.phantom_frames, 0);
}

TEST(EvaluatePeople, OnlyCoveredFramesCountForTheShare) {
  TruePerson anna = Standing("anna", 0, 10, 0);
  for (int frame = 0; frame < 5; ++frame) anna.covered[static_cast<std::size_t>(frame)] = false;
  const PeopleEvaluation evaluation = EvaluatePeople({{"person-1", TrackedAt(4, 9, 0)}}, {anna});
  EXPECT_EQ(evaluation.followed[0].covered, 5);
  EXPECT_EQ(evaluation.followed[0].found_covered, 4);
}

TEST(EvaluatePeople, OneOfSeveralIsHeldAgainstWhoeverHeWas) {
  const Evaluation evaluation =
      EvaluateOne(TrackedAt(0, 5, 40) + TrackedAt(5, 10, 2020),
                  {Standing("anna", 0, 10, 0), Standing("bert", 0, 10, 2000)});
  ASSERT_TRUE(evaluation.accuracy);
  EXPECT_NEAR(evaluation.accuracy->distance_mm.mean, 30, 1e-9);
  ASSERT_EQ(evaluation.accuracy->frames.size(), 10u);
  EXPECT_EQ(evaluation.accuracy->frames[7].pose, 7);
}

TEST(PeopleText, HasARowForEachAndTheSum) {
  PeopleEvaluation evaluation =
      EvaluatePeople({{"person-1", TrackedAt(0, 10, 2010)}, {"person-7", TrackedAt(2, 10, 5000)}},
                     {Standing("anna", 0, 10, 0), Standing("bert", 0, 10, 2000)});
  evaluation.take = "pair";
  const std::string text = PeopleText(evaluation);
  EXPECT_THAT(text, HasSubstr("pair: 2 people tracked, 2 people there"));
  EXPECT_THAT(text, ::testing::ContainsRegex("person-1 +10 +10 +0\\.0 +0  bert +10\\.0 +0 +0\n"));
  EXPECT_THAT(text, ::testing::ContainsRegex("person-7 +8 +8 +0\\.0 +0  - +- +8 +0\n"));
  EXPECT_THAT(text, ::testing::ContainsRegex("anna +10 +0 +10 +0\\.0 % +- +0\n"));
  EXPECT_THAT(text, ::testing::ContainsRegex("all +20 +10 +20 +50\\.0 % +10\\.0 +0\n"));
  EXPECT_THAT(text, HasSubstr("covered: frames in which at least four cameras show the whole"));
  EXPECT_THAT(PeopleReportHtml(evaluation, {}, {}), HasSubstr("\"text\":\"covered: frames in"));
  EXPECT_THAT(text, HasSubstr("frames of tracks without a person (phantom): 8\n"));
  const std::string json = PeopleJson(evaluation);
  EXPECT_THAT(json, HasSubstr("\"phantom_frames\":8,\"duplicate_frames\":0}"));
  EXPECT_THAT(json, HasSubstr("\"name\":\"person-1\",\"true_person\":\"bert\""));
  EXPECT_THAT(json, HasSubstr("\"found_while_covered_share\":0.5,"));
}

TEST(PeopleText, ProbabilitiesAreThoseOfEverybody) {
  const auto sure = [](Result result, double probability) {
    for (PoseRow& row : result.poses) row.probability = probability;
    return result;
  };
  const PeopleEvaluation evaluation =
      EvaluatePeople({{"person-1", sure(TrackedAt(0, 10, 2010), 0.99)},
                      {"person-2", sure(TrackedAt(0, 10, 10) + TrackedAt(10, 15, 150), 0.97)}},
                     {Standing("anna", 0, 15, 0), Standing("bert", 0, 15, 2000)});
  EXPECT_THAT(PeopleText(evaluation), HasSubstr("\n  0.9 to 1             25    0.978   80.0 %\n"));
  EXPECT_THAT(PeopleJson(evaluation),
              HasSubstr("\"probabilities\":[{\"from\":0,\"to\":0.5,\"frames\":0},"));
}

TEST(PeopleText, NothingIsSaidOfFramesThatAreNone) {
  TruePerson anna = Standing("anna", 0, 3, 0);
  anna.covered.assign(3, false);
  const PeopleEvaluation evaluation = EvaluatePeople({{"person-1", TrackedAt(0, 3, 5000)}}, {anna});
  EXPECT_THAT(PeopleText(evaluation), ::testing::ContainsRegex("anna +3 +0 +0 +- +- +0\n"));
  const auto data = testing::ReportData(PeopleReportHtml(evaluation, {}, {}));
  EXPECT_EQ(testing::TableOf(data, "true")["rows"][0],
            (nlohmann::ordered_json{"anna", 3, 0, 0, nullptr, 0, nullptr}));
  EXPECT_THAT(PeopleJson(evaluation), ::testing::Not(HasSubstr("found_while_covered_share")));
}

TEST(PeopleText, WithoutTruthSaysWhatItCan) {
  const std::string text = PeopleText(EvaluatePeople({{"person-1", TrackedAt(0, 3, 0)}}, {}));
  EXPECT_THAT(text, HasSubstr("person-1"));
  EXPECT_THAT(text, HasSubstr("no truth"));
}

}  // namespace
}  // namespace mocap
