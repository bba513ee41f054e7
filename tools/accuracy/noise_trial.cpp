#include "tools/accuracy/noise_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/errors.h"
#include "core/hypotheses/hypothesis.h"
#include "core/proposals/stance_search.h"
#include "drivers/simulation/simulated_studio.h"
#include "drivers/virtual_studio/truth.h"
#include "tools/accuracy/residual_fit.h"
#include "tools/accuracy/simulated_points.h"

namespace mocap {
namespace {

// Sets are measured about ten times a second, and their odds once.
constexpr double kBetweenSets_s = 0.1;
constexpr int kSetsPerOdds = 10;
// True joints are exact; the body's are within some centimetres of them.
constexpr double kJointStd_mm = 10;
// Where the tracked pose is so wrong that the body does not come nearer, nothing is measured.
constexpr double kMostAway_mm = 60;
constexpr double kStart_mm = 200, kStart_rad = 1;
constexpr Iterations kPatient{.usual = 30, .most = 30};
// Mean distances of right and wrong poses from the true joints. Between them are those with a lost
// limb, or none.
constexpr double kRight_mm = 70, kWrong_mm = 120;
// Poses that are nearer to each other are the same.
constexpr double kSamePose_mm = 30;
// Few residuals say little about the mean of a part. Flesh is compared at three places of a part.
constexpr std::size_t kFewest = 3;

// Moves a body to the true joints.
PoseState TruePoseOf(const BodyModel& body, const PoseState& start, const ScoredPoints& points_W) {
  PoseFilter filter{MotionNoise{}};
  filter.Reset(start, kStart_mm, kStart_rad);
  Eigen::Matrix<double, 3, Eigen::Dynamic> J(3, body.dof());
  filter.Draw(
      [&](const PoseState& pose, UpdateEquations& equations) {
        const Posture posture = body.PostureAt(pose);
        const BodyPoints at_W = body.PointsAt(posture);
        for (int i = 0; i < kScoredPointCount; ++i) {
          const Vector3 p_W = at_W.col(static_cast<int>(kScoredPoints[i]));
          body.PointJacobian(posture, body.CarrierOf(kScoredPoints[i]), p_W, J);
          equations.AddPoint(J, points_W.col(i) - p_W, kJointStd_mm * kJointStd_mm);
        }
      },
      kPatient);
  return filter.pose();
}

double AwayFrom(const ScoredPoints& points_W, const BodyModel& body, const PoseState& pose) {
  const ScoredPoints at_W = ScoredPointsOf(body.PointsAt(body.PostureAt(pose)));
  return (at_W - points_W).colwise().norm().mean();
}

// Residuals of one set by kind and capsule. What is out of reach is no residual.
class ResidualGroups {
 public:
  explicit ResidualGroups(int set) : set_(set) {}

  void Add(NoiseKind kind, int capsule, double residual_mm) {
    if (std::abs(residual_mm) > kReach_mm) return;
    ResidualGroup& group = groups_[{static_cast<int>(kind), capsule}];
    group.kind = kind;
    group.capsule = capsule;
    group.set = set_;
    group.residuals_mm.push_back(static_cast<float>(residual_mm));
  }

  void MoveTo(NoiseTake& take) {
    for (auto& [key, group] : groups_) take.groups.push_back(std::move(group));
  }

 private:
  int set_;
  std::map<std::pair<int, int>, ResidualGroup> groups_;
};

NoiseKind NoiseKindOf(ResidualKind kind) {
  switch (kind) {
    case ResidualKind::kSurface:
      return NoiseKind::kSurface;
    case ResidualKind::kRay:
      return NoiseKind::kRay;
    case ResidualKind::kBorder:
      return NoiseKind::kBorder;
  }
  MOCAP_CHECK(false);
}

// Adds the distances of bones from flesh, at all places that the objective compares.
void AddFlesh(Objective& objective, const PosedBody& posed, ResidualGroups& groups) {
  const CapsuleSet carved = objective.contacts().CarvedAway();
  for (int i = 0; i < std::ssize(posed.capsules()); ++i) {
    if (carved >> i & 1) continue;
    for (const double share : kCoreShares) {
      const auto way_W = objective.flesh().WayToFlesh(CorePlace(posed.capsules()[i], share));
      groups.Add(NoiseKind::kFlesh, i, way_W ? way_W->norm() : 0);
    }
  }
}

// Likewise the depths of limbs in other parts.
void AddOverlaps(const PosedBody& posed, ResidualGroups& groups) {
  const std::vector<PosedCapsule>& capsules = posed.capsules();
  const std::vector<Capsule>& shape = posed.body().shape();
  for (int i = 0; i < std::ssize(capsules); ++i) {
    for (int j = 0; j < std::ssize(capsules); ++j) {
      if (!MayOverlap(shape[i].part, shape[j].part)) continue;
      for (const double share : kCoreShares) {
        const auto distance = capsules[j].DistanceTo(CorePlace(capsules[i], share));
        groups.Add(NoiseKind::kOverlap, i,
                   std::max(0.0, OverlapDepth(capsules[i], capsules[j], distance)));
      }
    }
  }
}

// The depths of all parts that reach below the floor, as one group.
void AddFloor(const PosedBody& posed, ResidualGroups& groups) {
  for (const LowestEnd& end : EndsBelowFloor(posed, ~CapsuleSet{0}))
    if (end.capsule >= 0) groups.Add(NoiseKind::kFloor, 0, end.depth_mm);
}

class ResidualKeeper : public PoseSink {
 public:
  ResidualKeeper(const SimulatedStudioOptions& studio, NoiseTake& take)
      : truth_(studio),
        every_(std::max(1, static_cast<int>(std::lround(studio.fps * kBetweenSets_s)))),
        take_(take) {
    take_.step_s = every_ / studio.fps;
  }

  void OnSet(const TrackedSet& set) override {
    if (set.result.state != CaptureState::kTracking) return;
    KeepContacts(set);
    if (set.frame % every_ != 0) return;
    evidence_.Gather(Observation(set.grid, set.outlines));
    const auto number = static_cast<int>(set.frame / every_);
    const ScoredPoints points_W = TrueScoredPoints(truth_, set.capture_ns);
    const PoseState pose = TruePoseOf(set.body, set.result.pose, points_W);
    if (AwayFrom(points_W, set.body, pose) > kMostAway_mm) {
      ++take_.left_out;
      return;
    }
    ++take_.sets;
    objective_.SetEvidence(evidence_);
    KeepResiduals(set.body, pose, number);
    if (number % kSetsPerOdds == 0) KeepOdds(set, pose, points_W);
  }

 private:
  void KeepContacts(const TrackedSet& set) {
    if (!set.result.contacts.allFinite()) return;
    const ScoredPoints apart_W =
        ScoredPointsOf(set.result.points_W) - TrueScoredPoints(truth_, set.capture_ns);
    const simulation::FloorContacts touches = truth_.ContactsAt(set.capture_ns);
    for (int i = 0; i < kContactCount; ++i) {
      const auto* foot =
          std::ranges::find(kScoredPoints, i % 2 == 0 ? Point::kFootL : Point::kFootR);
      if (apart_W.col(foot - kScoredPoints.begin()).norm() > kMostAway_mm) continue;
      const bool is_heel = i < kContactCount / 2;
      auto& samples = is_heel ? take_.contacts.heels : take_.contacts.toes;
      samples.push_back({set.result.foot_motions[i], touches[i]});
    }
  }

  void KeepResiduals(const BodyModel& body, const PoseState& pose, int number) {
    ResidualGroups groups(number);
    for (const SurfaceResidual& residual : objective_.ResidualsAt(body, pose))
      groups.Add(NoiseKindOf(residual.kind), residual.capsule, residual.outside_mm);
    PosedBody posed;
    posed.Set(body, pose);
    AddFlesh(objective_, posed, groups);
    AddOverlaps(posed, groups);
    AddFloor(posed, groups);
    groups.MoveTo(take_);
  }

  struct Fitted {
    PoseState pose;
    Fitness fitness;
  };

  Fitted FitFrom(const BodyModel& body, const PoseState& start) {
    PoseFilter filter{MotionNoise{}};
    filter.Reset(start, kStart_mm, kStart_rad);
    DrawNear(objective_, body, kAnyThings, kPatient, filter);
    return {filter.pose(), objective_.At(body, filter.pose(), kAnyThings)};
  }

  void KeepOdds(const TrackedSet& set, const PoseState& true_pose, const ScoredPoints& points_W) {
    StanceSearch search(set.body);
    std::vector<Fitted> all = {FitFrom(set.body, true_pose), FitFrom(set.body, set.result.pose)};
    for (const StanceCandidate& candidate : search.Find(objective_, {}))
      all.push_back(FitFrom(set.body, candidate.pose));
    std::ranges::stable_sort(all, {}, [](const Fitted& one) { return one.fitness.Sum(); });
    OddsFrame frame;
    std::vector<PoseState> known;
    for (const Fitted& one : all) {
      const auto is_same = [&](const PoseState& pose) {
        return MeanDistance(set.body, pose, set.body, one.pose) < kSamePose_mm;
      };
      if (std::ranges::any_of(known, is_same)) continue;
      known.push_back(one.pose);
      const double away_mm = AwayFrom(points_W, set.body, one.pose);
      if (away_mm < kRight_mm) frame.right.push_back(one.fitness.nats);
      if (away_mm > kWrong_mm) frame.wrong.push_back(one.fitness.nats);
    }
    if (!frame.right.empty() && !frame.wrong.empty()) take_.odds.push_back(std::move(frame));
  }

  const SimulatedTruth truth_;
  const int every_;
  NoiseTake& take_;
  Evidence evidence_;
  Objective objective_;
};

template <typename Visit>
void ForEachGroup(std::span<const NoiseTake> takes, NoiseKind kind, std::size_t first,
                  const Visit& visit) {
  for (std::size_t t = first; t < takes.size(); t += 2)
    for (const ResidualGroup& group : takes[t].groups)
      if (group.kind == kind) visit(group);
}

// Places in flesh are known only to be less than half a voxel outside of it.
Residuals ResidualsOf(std::span<const NoiseTake> takes, NoiseKind kind, std::size_t first) {
  Residuals residuals;
  residuals.least_mm = takes.front().voxel_mm / 2;
  const bool is_distance = kind == NoiseKind::kFlesh || kind == NoiseKind::kOverlap;
  ForEachGroup(takes, kind, first, [&](const ResidualGroup& group) {
    for (const float r : group.residuals_mm) {
      if (is_distance && r < residuals.least_mm)
        ++residuals.small;
      else
        residuals.mm.push_back(r);
    }
  });
  return residuals;
}

// Derivatives of -log p by the residuals [1/mm]. Those of independent residuals average out in a
// part.
class PartScores {
 public:
  PartScores(std::span<const NoiseTake> takes, NoiseKind kind, const ResidualNoise& noise)
      : kind_(kind), noise_(noise) {
    double count = 0, sum = 0, squares = 0;
    ForEachGroup(takes, kind, 0, [&](const ResidualGroup& group) {
      for (const double r : group.residuals_mm) {
        const double score = At(r);
        ++count;
        sum += score;
        squares += score * score;
      }
    });
    mean_ = sum / count;
    variance_ = squares / count - mean_ * mean_;
  }

  // If residuals were independent, means of n had a variance of variance_ / n.
  double CountAsOne(std::span<const NoiseTake> takes) const {
    double expected = 0, found = 0;
    ForEachGroup(takes, kind_, 0, [&](const ResidualGroup& group) {
      if (group.residuals_mm.size() < kFewest) return;
      const double mean = MeanOf(group);
      expected += variance_ / static_cast<double>(group.residuals_mm.size());
      found += mean * mean;
    });
    return expected > 0 ? std::max(1.0, found / expected) : 1;
  }

  double CorrelationOverTime(std::span<const NoiseTake> takes) const {
    double products = 0, squares = 0;
    for (const NoiseTake& take : takes) {
      std::map<int, std::pair<int, double>> last;  // By capsule: set and mean.
      ForEachGroup({&take, 1}, kind_, 0, [&](const ResidualGroup& group) {
        if (group.residuals_mm.size() < kFewest) return;
        const double mean = MeanOf(group);
        const auto before = last.find(group.capsule);
        if (before != last.end() && before->second.first == group.set - 1) {
          products += mean * before->second.second;
          squares += (mean * mean + before->second.second * before->second.second) / 2;
        }
        last[group.capsule] = {group.set, mean};
      });
    }
    return squares > 0 ? products / squares : 0;
  }

 private:
  double At(double r) const { return r == 0 ? 0 : r / noise_.VarianceAt(r); }
  double MeanOf(const ResidualGroup& group) const {
    double sum = 0;
    for (const double r : group.residuals_mm) sum += At(r);
    return sum / static_cast<double>(group.residuals_mm.size()) - mean_;
  }

  NoiseKind kind_;
  ResidualNoise noise_;
  double mean_ = 0, variance_ = 0;
};

std::string ScaleText(double scale_mm) {
  return scale_mm > 0 ? fmt::format("{:.1f}", scale_mm) : "–";
}

}  // namespace

NoiseTake RunNoiseTrial(const AccuracyTrial& trial) {
  NoiseTake take;
  take.voxel_mm = trial.voxel_mm;
  ResidualKeeper keeper(trial.studio, take);
  TrackStudio(trial, OpenSimulatedStudio(trial.studio), keeper);
  return take;
}

MeasuredNoise FitNoise(std::span<const NoiseTake> takes, NoiseKind kind) {
  const Residuals fitted = ResidualsOf(takes, kind, 0), others = ResidualsOf(takes, kind, 1);
  MeasuredNoise measured{.noise = FitResiduals(fitted), .residuals = fitted.count()};
  measured.far_share = static_cast<double>(fitted.mm.size()) / fitted.count();
  measured.others_nats = MeanNats(others, measured.noise);
  measured.own_nats = MeanNats(others, FitResiduals(others));
  const PartScores scores(takes, kind, measured.noise);
  measured.correlation = scores.CorrelationOverTime(takes);
  measured.noise.alike = scores.CountAsOne(takes);
  return measured;
}

std::string NoiseTable(std::span<const NoiseTake> takes) {
  if (takes.size() < 2) return {};
  int sets = 0, left_out = 0, fitted = 0;
  std::vector<OddsTake> odds;
  std::vector<ContactTake> contacts;
  for (std::size_t t = 0; t < takes.size(); ++t) {
    sets += takes[t].sets;
    left_out += takes[t].left_out;
    if (t % 2 == 0) fitted += takes[t].sets;
    odds.push_back(takes[t].odds);
    contacts.push_back(takes[t].contacts);
  }
  std::string text = fmt::format(
      "\n## Noise of the evidence\n{} sets of {} people at their true poses ({} left out). Half of "
      "the people are fitted, the others check.\n\n| evidence | freedom | inside mm | outside mm | "
      "far % | count as one | correlation after {:.1f} s | a set | nats of the others | by their "
      "own noise |\n|---|---|---|---|---|---|---|---|---|---|\n",
      sets, takes.size(), left_out, takes.front().step_s);
  for (std::size_t k = 0; k < kNoiseKindNames.size(); ++k) {
    const auto kind = static_cast<NoiseKind>(k);
    if (ResidualsOf(takes, kind, 0).mm.empty() || ResidualsOf(takes, kind, 1).mm.empty()) continue;
    const MeasuredNoise m = FitNoise(takes, kind);
    text += fmt::format(
        "| {} | {:.2f} | {} | {} | {:.2f} | {:.1f} | {:.2f} | {:.0f} | {:.3f} | {:.3f} |\n",
        kNoiseKindNames[k], m.noise.freedom, ScaleText(m.noise.inside_mm),
        ScaleText(m.noise.outside_mm), 100 * m.far_share, m.noise.alike, m.correlation,
        m.residuals / fitted, m.others_nats, m.own_nats);
  }
  return text + ContactTable(contacts) + OddsTables(odds);
}

}  // namespace mocap
