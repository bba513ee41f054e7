#include "core/hypotheses/hypothesis_set.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/support/allocation_counter.h"
#include "tests/support/fitted_body.h"
#include "tests/support/voxelized_shapes.h"

namespace mocap {
namespace {

// Nothing is seen of anybody, but where the feet point: habits alone tell poses apart, and
// how much is known exactly.
class Odds : public FittedBody {
 protected:
  Odds() {
    blind_.SetEvidence(evidence_);
    believed_.filter.Reset(ahead_, 20, 0.1);
  }

  /// The same stance elsewhere.
  Hypothesis Aside(double mm, double nats) const {
    PoseState pose = ahead_;
    pose.X_WT.p.x() += mm;
    Hypothesis hypothesis(body_, pose, false);
    hypothesis.nats = nats;
    return hypothesis;
  }
  /// A set with a hypothesis of 0 nats that is believed, and others.
  HypothesisSet SetWith(std::vector<Hypothesis> others) const {
    HypothesisSet set;
    set.Begin({believed_});
    for (Hypothesis& other : others) set.Offer(std::move(other));
    return set;
  }
  static bool IsAside(const HypothesisSet& set, double mm) {
    return std::abs(set.best().filter.pose().X_WT.p.x() - kX_mm - mm) < 1e-9;
  }

  /// How long it takes until somebody is turned who faces away from the feet, if frames come so
  /// often and the other facing is less probable at first.
  double TurnedAfter(double period_s, double behind_nats) {
    evidence_.toes_W = ExpRotation(Vector3(0, 0, 1.2)) * ahead_.X_WT.R.col(0);
    blind_.SetEvidence(evidence_);
    PoseState turned = ahead_;
    turned.X_WT.R = turned.X_WT.R * ExpRotation(Vector3(0, 0, EIGEN_PI));
    Hypothesis right(body_, ahead_, false), wrong(body_, turned, false);
    HypothesisSet set;
    set.Begin({wrong});
    right.nats = behind_nats;
    set.Offer(right);
    double time_s = 0;
    while (set.best().filter.pose().X_WT.R.col(0).dot(ahead_.X_WT.R.col(0)) < 0 && time_s < 20) {
      set.Follow(blind_, period_s);
      time_s += period_s;
    }
    return time_s;
  }

  static constexpr double kX_mm = 50;
  Objective blind_{{.voxels = 0, .rays = 0}};
  const PoseState ahead_ = Standing({});
  Hypothesis believed_{body_, ahead_, false};
};

TEST_F(Odds, RivalsThatComeAndGoReuseMemory) {
  if (!kCountsAllocations) GTEST_SKIP() << "the sanitizer allocates by itself";
  HypothesisSet set = SetWith({});
  Hypothesis present = believed_;
  const PoseState elsewhere = Aside(500, 0).filter.pose();
  const auto come_and_go = [&] {
    set.Vary(blind_, present, elsewhere);
    ASSERT_EQ(set.all().size(), 2u);
    set.all().back().nats = std::log(1001);
    set.Judge();
    ASSERT_EQ(set.all().size(), 1u);
  };
  for (int i = 0; i < 3; ++i) come_and_go();
  const std::int64_t before = Allocations();
  EXPECT_GT(before, 0);
  come_and_go();
  EXPECT_EQ(Allocations() - before, 0);
}

TEST_F(Odds, OfNineteenToOneChangeTheMind) {
  EXPECT_TRUE(IsAside(SetWith({Aside(500, -std::log(18.9))}), 0));
  EXPECT_TRUE(IsAside(SetWith({Aside(500, -std::log(19.1))}), 500));
}

TEST_F(Odds, OfTheLikeliestChangeTheMind) {
  HypothesisSet set = SetWith({Aside(500, 1), Aside(1000, 2)});
  set.all()[1].nats = -4;
  set.all()[2].nats = -9;
  set.Judge();
  EXPECT_TRUE(IsAside(set, 1000));
}

TEST_F(Odds, GiveEachHypothesisItsProbability) {
  constexpr std::array kNats = {0.0, 1.3, 2.1};
  const double whole = std::exp(-kNats[0]) + std::exp(-kNats[1]) + std::exp(-kNats[2]);
  double sum = 0;
  for (std::size_t first = 0; first < kNats.size(); ++first) {
    HypothesisSet set = SetWith({Aside(500, 1), Aside(1000, 1)});
    ASSERT_EQ(set.all().size(), kNats.size());
    for (std::size_t i = 0; i < kNats.size(); ++i)
      set.all()[i].nats = kNats[(first + i) % kNats.size()];
    EXPECT_GT(set.ProbabilityOf(set.best()), 0);
    EXPECT_LT(set.ProbabilityOf(set.best()), 1);
    EXPECT_NEAR(set.ProbabilityOf(set.best()), std::exp(-kNats[first]) / whole, 1e-9);
    sum += set.ProbabilityOf(set.best());
  }
  EXPECT_NEAR(sum, 1, 1e-9);
}

TEST_F(Odds, AreSureWhereThereIsOneHypothesis) {
  HypothesisSet set = SetWith({});
  EXPECT_EQ(set.ProbabilityOf(set.best()), 1);
  EXPECT_EQ(set.Rival(), nullptr);
}

TEST_F(Odds, NameTheLikeliestOfTheOthers) {
  HypothesisSet set = SetWith({Aside(500, 2), Aside(1000, 1)});
  ASSERT_NE(set.Rival(), nullptr);
  EXPECT_EQ(set.Rival()->nats, 1);
}

TEST_F(Odds, StayFiniteHoweverLongSomebodyIsFollowed) {
  HypothesisSet set = SetWith({Aside(500, 1)});
  evidence_.toes_W = -ahead_.X_WT.R.col(0);
  blind_.SetEvidence(evidence_);
  for (int i = 0; i < 200; ++i) set.Follow(blind_, 1);
  EXPECT_EQ(set.best().nats, 0);
  EXPECT_NEAR(set.ProbabilityOf(set.best()), 1 / (1 + std::exp(-1)), 0.01)
      << "they explain the same";
}

TEST_F(Odds, ThatStayEvenChangeNoMind) {
  HypothesisSet set = SetWith({Aside(500, -1)});
  for (int i = 0; i < 60; ++i) set.Follow(blind_, 1.0 / 30);
  ASSERT_EQ(set.all().size(), 2u);
  EXPECT_TRUE(IsAside(set, 0)) << "the other is likelier, but not by enough";
  EXPECT_LT(set.ProbabilityOf(set.best()), 0.5) << "which is not hidden";
}

TEST_F(Odds, EndWhatIsHardlyPossible) {
  EXPECT_EQ(SetWith({Aside(500, 2)}).all().size(), 2u);
  EXPECT_EQ(SetWith({Aside(500, 30)}).all().size(), 1u);
  EXPECT_EQ(SetWith({Aside(500, -30)}).all().size(), 1u) << "the one that was believed";
}

TEST_F(Odds, KeepTheLikeliestOfMany) {
  std::vector<Hypothesis> others;
  for (int i = 1; i <= 20; ++i) others.push_back(Aside(200 * i, 3 + 0.1 * ((7 * i) % 20)));
  const HypothesisSet set = SetWith(others);
  ASSERT_GT(set.all().size(), 1u);
  EXPECT_LT(set.all().size(), 8u);
  for (std::size_t i = 1; i < set.all().size(); ++i)
    EXPECT_NEAR(set.all()[i].nats, 3 + 0.1 * static_cast<double>(i - 1), 1e-9);
}

TEST_F(Odds, TwoOfOnePoseBecomeTheLikelier) {
  const auto meeting = [&](double nats) {
    HypothesisSet set = SetWith({Aside(500, 1)});
    set.all()[1] = Aside(5, nats);
    set.Judge();
    return set;
  };
  const HypothesisSet behind = meeting(1), ahead = meeting(-1);
  ASSERT_EQ(behind.all().size(), 1u);
  EXPECT_TRUE(IsAside(behind, 0));
  ASSERT_EQ(ahead.all().size(), 1u);
  EXPECT_TRUE(IsAside(ahead, 5)) << "although the odds are small";
  EXPECT_EQ(SetWith({Aside(100, 1)}).all().size(), 2u);
}

TEST_F(Odds, TwoOfOnePoseThatIsNotBelievedBecomeOneToo) {
  HypothesisSet set = SetWith({Aside(500, 2), Aside(1000, 1)});
  set.all()[1] = Aside(500, 2);
  set.all()[2] = Aside(505, 1);
  set.Judge();
  ASSERT_EQ(set.all().size(), 2u);
  EXPECT_TRUE(IsAside(set, 0));
  EXPECT_NEAR(set.all()[1].nats, 1, 1e-9);
}

TEST_F(Odds, AgainstAPoseStayWhenItIsProposedAgain) {
  evidence_.toes_W = ahead_.X_WT.R.col(0);
  blind_.SetEvidence(evidence_);
  PoseState turned = ahead_;
  turned.X_WT.R = turned.X_WT.R * ExpRotation(Vector3(0, 0, EIGEN_PI));
  Hypothesis ahead(body_, ahead_, false);
  ahead.Fit(blind_);
  HypothesisSet set;
  set.Begin({ahead});
  set.Follow(blind_, 0.01);
  Hypothesis present = set.best();
  set.Vary(blind_, present, turned);
  for (int i = 0; i < 9; ++i) set.Follow(blind_, 0.01);
  ASSERT_EQ(set.all().size(), 2u);
  const double probability = set.ProbabilityOf(set.best());
  present = set.best();
  set.Vary(blind_, present, turned);
  EXPECT_EQ(set.all().size(), 2u);
  EXPECT_GE(set.ProbabilityOf(set.best()), probability);
}

TEST_F(Odds, AreIntegratedOverTimeAndNotOverFrames) {
  const double often_s = TurnedAfter(1.0 / 60, 5), usually_s = TurnedAfter(1.0 / 30, 5),
               rarely_s = TurnedAfter(0.1, 5);
  EXPECT_GT(rarely_s, 0.2) << "so few frames would decide that the rates hardly differ";
  EXPECT_LT(rarely_s, 19);
  EXPECT_NEAR(often_s, rarely_s, 0.1 + 1e-6);
  EXPECT_NEAR(usually_s, rarely_s, 0.1 + 1e-6);
}

TEST_F(Odds, TakeLongerWhereMoreSpeaksAgainst) {
  EXPECT_GT(TurnedAfter(1.0 / 30, 5), TurnedAfter(1.0 / 30, 1));
}

TEST_F(Odds, OfOneFrameAfterAGapCountAsOneFrame) {
  evidence_.toes_W = -ahead_.X_WT.R.col(0);
  const auto after = [&](double gap_s) {
    PoseState turned = ahead_;
    turned.X_WT.R = turned.X_WT.R * ExpRotation(Vector3(0, 0, EIGEN_PI));
    Hypothesis other(body_, turned, false);
    other.nats = 1;
    HypothesisSet set = SetWith({other});
    blind_.SetEvidence(evidence_);
    set.Follow(blind_, gap_s);
    Fitness nat;
    nat[Term::kRays] = 1;
    EXPECT_LE(set.NatsOf(nat), 1);
    return set.all()[1].nats;
  };
  EXPECT_NEAR(after(3), after(30), 1e-9);
}

TEST_F(Odds, DoNotChangeWhileTheClockStandsStill) {
  evidence_.toes_W = -ahead_.X_WT.R.col(0);
  blind_.SetEvidence(evidence_);
  PoseState turned = ahead_;
  turned.X_WT.R = turned.X_WT.R * ExpRotation(Vector3(0, 0, EIGEN_PI));
  Hypothesis other(body_, turned, false);
  other.nats = 1;
  HypothesisSet set = SetWith({other});
  for (int i = 0; i < 50; ++i) set.Follow(blind_, 0);
  ASSERT_EQ(set.all().size(), 2u);
  EXPECT_NEAR(set.all()[1].nats, 1, 1e-9);
}

TEST_F(Odds, EndNobodyWhoIsOnTrial) {
  Hypothesis newcomer = Aside(500, 30);
  newcomer.trials = 1;
  HypothesisSet set = SetWith({newcomer});
  EXPECT_EQ(set.all().size(), 2u);
  set.all()[1].trials = 0;
  set.Judge();
  EXPECT_EQ(set.all().size(), 1u);
}

TEST_F(Odds, OfATrialAreThoseOfThePresentFrame) {
  Hypothesis newcomer = Aside(500, 5);
  newcomer.trials = 1;
  HypothesisSet set = SetWith({newcomer});
  set.Follow(blind_, 0.1);
  ASSERT_EQ(set.all().size(), 2u);
  EXPECT_NEAR(set.all()[1].nats, set.all()[0].nats, 1e-3) << "they explain the same";
}

class Followed : public FittedBody {
 protected:
  HypothesisSet Begin(const PoseState& pose) {
    HypothesisSet set;
    set.Begin({HypothesisAt(pose)});
    return set;
  }
  HypothesisSet RaisedIsBelieved(const PoseState& begin, const PoseState& offered) {
    HypothesisSet set = Begin(begin);
    VaryBest(set, offered);
    for (int i = 0; i < 6; ++i) Follow(set, 1.0 / 30);
    EXPECT_LT(Error(set.best().filter.pose(), raised_), 15);
    EXPECT_GT(set.ProbabilityOf(set.best()), 0.95);
    return set;
  }
  void VaryBest(HypothesisSet& set, const PoseState& pose) {
    Hypothesis present = set.best();
    set.Vary(objective_, present, pose);
  }
  void Follow(HypothesisSet& set, double dt_s) { set.Follow(objective_, dt_s); }

  const PoseState hanging_ = Standing({});
  const PoseState raised_ = Standing({.arm_l = {.raise = 30, .forward = 30, .elbow = 60}});
};

TEST_F(Followed, APoseThatExplainsMoreIsBelieved) {
  See(raised_);
  RaisedIsBelieved(hanging_, raised_);
}

TEST_F(Followed, APoseThatExplainsMoreTakesOverTheTrials) {
  See(raised_);
  HypothesisSet set;
  Hypothesis newcomer = HypothesisAt(hanging_);
  newcomer.Fit(objective_);
  newcomer.trials = 5;
  set.Begin({newcomer});
  Hypothesis present = set.best();
  set.Vary(objective_, present, raised_);
  int on_trial = 0;
  for (const Hypothesis& one : set.all()) {
    if (one.trials == 0) continue;
    ++on_trial;
    EXPECT_EQ(one.trials, 5);
    EXPECT_LT(Error(one.filter.pose(), raised_), 15);
  }
  EXPECT_EQ(on_trial, 1);
}

TEST_F(Followed, APoseThatExplainsLessIsNot) {
  See(raised_);
  EXPECT_EQ(RaisedIsBelieved(raised_, hanging_).all().size(), 1u);
}

TEST_F(Followed, APoseThatBecomesTheBelievedOneIsGivenUp) {
  See(hanging_);
  HypothesisSet set = Begin(hanging_);
  VaryBest(set, Standing({.arm_l = {.raise = -70}}));
  EXPECT_EQ(set.all().size(), 1u);
}

TEST_F(Followed, ALeapBeyondTheReachIsFollowed) {
  PoseState truth = Standing({.arm_l = kArmOut});
  See(truth);
  HypothesisSet set = Begin(truth);
  Follow(set, 0.1);
  truth.X_WT.p += Vector3(60, 0, 300);
  See(truth);
  Follow(set, 0.1);
  EXPECT_LT(Error(set.best().filter.pose(), truth), 20);
}

TEST_F(Followed, VoxelsThatLeaveABodyThatStandsDoNotTakeItAlong) {
  const PoseState truth = Standing({});
  See(truth);
  HypothesisSet set = Begin(truth);
  Follow(set, 0.1);
  evidence_.cloud.Build(
      FillGrid({900, 900, 0}, {1500, 1500, 600}, 25, [](const Vector3&) { return true; }));
  Follow(set, 0.1);
  EXPECT_LT(Error(set.best().filter.pose(), truth), 15);
}

TEST_F(Followed, AFitThatFailedIsNoHypothesis) {
  See(hanging_);
  HypothesisSet set = Begin(hanging_);
  Hypothesis broken = HypothesisAt(raised_);
  broken.nats = -100;
  broken.filter.Update(
      [](const PoseState& pose, UpdateEquations& equations) {
        equations.Add(PoseStep::Ones(pose.dof()), std::nan(""), 1);
      },
      Iterations{});
  ASSERT_FALSE(broken.filter.is_sound());
  set.Offer(std::move(broken));
  EXPECT_EQ(set.all().size(), 1u);
  EXPECT_LT(Error(set.best().filter.pose(), hanging_), 15);
}

TEST_F(Followed, TheSameInputGivesTheSameBits) {
  See(raised_);
  HypothesisSet one = Begin(hanging_), other = Begin(hanging_);
  for (HypothesisSet* set : {&one, &other}) {
    VaryBest(*set, Standing({.arm_l = {.raise = 20, .elbow = 30}}));
    for (int i = 0; i < 3; ++i) Follow(*set, 1.0 / 30);
  }
  ASSERT_EQ(one.all().size(), other.all().size());
  for (std::size_t i = 0; i < one.all().size(); ++i) {
    EXPECT_EQ(one.all()[i].nats, other.all()[i].nats);
    EXPECT_EQ(one.all()[i].filter.pose().theta, other.all()[i].filter.pose().theta);
    EXPECT_EQ(one.all()[i].filter.pose().X_WT.p, other.all()[i].filter.pose().X_WT.p);
    EXPECT_EQ(one.all()[i].filter.covariance(), other.all()[i].filter.covariance());
  }
}

}  // namespace
}  // namespace mocap
