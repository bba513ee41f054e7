#include "tools/accuracy/noise_trial.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

#include "core/tracking/evidence.h"
#include "core/tracking/pose_filter.h"
#include "tools/accuracy/simulated_points.h"

namespace mocap {
namespace {

// Sets are measured about ten times a second.
constexpr double kBetweenSets_s = 0.1;
// True joints are exact; the body's are within some centimetres of them.
constexpr double kJointStd_mm = 10;
// Where the tracked pose is so wrong that the body does not come nearer, nothing is measured.
constexpr double kMostAway_mm = 60;
constexpr double kStart_mm = 200, kStart_rad = 1;
constexpr Iterations kPatient{.usual = 30, .most = 30};
// Few residuals say little about the mean of a part.
constexpr std::size_t kFewest = 4;
constexpr int kRounds = 200;

// Moves a body to the true joints.
PoseState TruePoseOf(const BodyModel& body, const PoseState& start, const ScoredPoints& points_W) {
  PoseFilter filter{MotionNoise{}};
  filter.Reset(start, kStart_mm, kStart_rad);
  Eigen::Matrix<double, 3, Eigen::Dynamic> J(3, body.dof());
  filter.Draw(
      body.table(),
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

class ResidualKeeper : public PoseSink {
 public:
  ResidualKeeper(const SimulatedStudioOptions& studio, NoiseTake& take)
      : truth_(studio),
        every_(std::max(1, static_cast<int>(std::lround(studio.fps * kBetweenSets_s)))) {
    take_ = &take;
    take.step_s = every_ / studio.fps;
  }

  void OnSet(const TrackedSet& set) override {
    if (set.result.state != CaptureState::kTracking || set.frame % every_ != 0) return;
    const ScoredPoints points_W = TrueScoredPoints(truth_, set.capture_ns);
    const PoseState pose = TruePoseOf(set.body, set.result.pose, points_W);
    const ScoredPoints at_W = ScoredPointsOf(set.body.PointsAt(set.body.PostureAt(pose)));
    if ((at_W - points_W).colwise().norm().mean() > kMostAway_mm) {
      ++take_->left_out;
      return;
    }
    evidence_.Gather(Sighting(set.grid, set.outlines));
    fit_.SetEvidence(evidence_);
    std::map<std::pair<int, int>, ResidualGroup> groups;
    for (const SurfaceResidual& residual : fit_.ResidualsAt(set.body, pose)) {
      ResidualGroup& group = groups[{static_cast<int>(residual.kind), residual.capsule}];
      group.kind = residual.kind;
      group.capsule = residual.capsule;
      group.set = static_cast<int>(set.frame / every_);
      group.residuals_mm.push_back(static_cast<float>(residual.outside_mm));
    }
    for (auto& [key, group] : groups) take_->groups.push_back(std::move(group));
    ++take_->sets;
  }

 private:
  const SimulatedTruth truth_;
  const int every_;
  NoiseTake* take_;
  Evidence evidence_;
  SurfaceFit fit_{SurfaceFitOptions{}};
};

template <typename Visit>
void ForEachResidual(std::span<const NoiseTake> takes, ResidualKind kind, std::size_t first,
                     const Visit& visit) {
  for (std::size_t t = first; t < takes.size(); t += 2) {
    for (const ResidualGroup& group : takes[t].groups) {
      if (group.kind != kind) continue;
      for (const double r : group.residuals_mm) visit(r);
    }
  }
}

// Expectation maximization of sigma and share of outliers.
ResidualNoise Fit(std::span<const NoiseTake> takes, ResidualKind kind, std::size_t first) {
  ResidualNoise noise{.sigma_mm = 30, .outlier_share = 0.1, .reach_mm = 0};
  noise.reach_mm = 2 * SurfaceFitOptions{}.reach_mm;
  for (int round = 0; round < kRounds; ++round) {
    double all = 0, inliers = 0, squares = 0;
    ForEachResidual(takes, kind, first, [&](double r) {
      const double inlier = noise.Inlier(r);
      ++all;
      inliers += inlier;
      squares += inlier * r * r;
    });
    noise.sigma_mm = std::sqrt(squares / inliers);
    noise.outlier_share = 1 - inliers / all;
  }
  return noise;
}

double MeanNats(std::span<const NoiseTake> takes, ResidualKind kind, std::size_t first,
                const ResidualNoise& noise) {
  double sum = 0, count = 0;
  ForEachResidual(takes, kind, first, [&](double r) {
    sum += noise.Nats(r);
    ++count;
  });
  return sum / count;
}

// The mean of the inliers of a part.
double MeanOf(const ResidualGroup& group, const ResidualNoise& noise) {
  double sum = 0, weight = 0;
  for (const double r : group.residuals_mm) {
    const double inlier = noise.Inlier(r);
    sum += inlier * r;
    weight += inlier;
  }
  return weight > 0 ? sum / weight : 0;
}

// If residuals were independent, means of n had a variance of sigma² / n.
double IndependentShare(std::span<const NoiseTake> takes, ResidualKind kind,
                        const ResidualNoise& noise) {
  double expected = 0, found = 0;
  for (std::size_t t = 0; t < takes.size(); t += 2) {
    for (const ResidualGroup& group : takes[t].groups) {
      if (group.kind != kind || group.residuals_mm.size() < kFewest) continue;
      const double mean = MeanOf(group, noise);
      expected += noise.sigma_mm * noise.sigma_mm / static_cast<double>(group.residuals_mm.size());
      found += mean * mean;
    }
  }
  return std::min(1.0, expected / found);
}

double CorrelationOverTime(std::span<const NoiseTake> takes, ResidualKind kind,
                           const ResidualNoise& noise) {
  double products = 0, squares = 0;
  for (const NoiseTake& take : takes) {
    std::map<int, std::pair<int, double>> last;  // By capsule: set and mean.
    for (const ResidualGroup& group : take.groups) {
      if (group.kind != kind || group.residuals_mm.size() < kFewest) continue;
      const double mean = MeanOf(group, noise);
      const auto before = last.find(group.capsule);
      if (before != last.end() && before->second.first == group.set - 1) {
        products += mean * before->second.second;
        squares += (mean * mean + before->second.second * before->second.second) / 2;
      }
      last[group.capsule] = {group.set, mean};
    }
  }
  return squares > 0 ? products / squares : 0;
}

}  // namespace

NoiseTake RunNoiseTrial(const AccuracyTrial& trial) {
  NoiseTake take;
  ResidualKeeper keeper(trial.studio, take);
  TrackStudio(trial, OpenSimulatedStudio(trial.studio), keeper);
  return take;
}

MeasuredNoise FitNoise(std::span<const NoiseTake> takes, ResidualKind kind) {
  MeasuredNoise measured{.noise = Fit(takes, kind, 0)};
  ForEachResidual(takes, kind, 0, [&](double) { ++measured.residuals; });
  measured.noise.independent_share = IndependentShare(takes, kind, measured.noise);
  measured.correlation = CorrelationOverTime(takes, kind, measured.noise);
  measured.others_nats = MeanNats(takes, kind, 1, measured.noise);
  measured.own_nats = MeanNats(takes, kind, 1, Fit(takes, kind, 1));
  return measured;
}

std::string NoiseTable(std::span<const NoiseTake> takes) {
  if (takes.size() < 2) return {};
  int sets = 0, left_out = 0;
  for (const NoiseTake& take : takes) {
    sets += take.sets;
    left_out += take.left_out;
  }
  std::string text = fmt::format(
      "\n## Noise of the evidence\n{} sets of {} people at their true poses ({} left out). Half of "
      "the people are fitted, the others check.\n\n| evidence | sigma mm | outliers % | "
      "independent "
      "% | correlation after {:.1f} s | residuals | nats of the others | by their own noise "
      "|\n|---|---|---|---|---|---|---|---|\n",
      sets, takes.size(), left_out, takes.front().step_s);
  for (std::size_t k = 0; k < kResidualKindNames.size(); ++k) {
    const MeasuredNoise m = FitNoise(takes, static_cast<ResidualKind>(k));
    text += fmt::format("| {} | {:.1f} | {:.1f} | {:.1f} | {:.2f} | {:.0f} | {:.3f} | {:.3f} |\n",
                        kResidualKindNames[k], m.noise.sigma_mm, 100 * m.noise.outlier_share,
                        100 * m.noise.independent_share, m.correlation, m.residuals, m.others_nats,
                        m.own_nats);
  }
  return text;
}

}  // namespace mocap
