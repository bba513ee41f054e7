#include "core/solving/pose_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/hypotheses/hypothesis_set.h"

namespace mocap {
namespace {

const double kJumpNats = std::log(kOdds.drop);

// The parts of a body that move against each other: its trunk, and the joints that follow from each
// joint at the trunk, such as an arm's. By place in a PoseStep, from 0.
std::vector<int> PartsOf(const BodyTable& table) {
  std::vector<int> parts(kTorsoDof, 0);
  for (const JointAxis& joint : table.joints)
    parts.push_back(joint.parent < 0 ? parts.back() + 1 : parts[kTorsoDof + joint.parent]);
  return parts;
}

// Costs of motions over a time of somebody whose velocity is not known. Each part may jump.
class MotionCost {
 public:
  MotionCost(std::span<const int> parts, double dt_s) : parts_(parts) {
    PoseFilter still(MotionNoise{});
    PoseState pose;
    pose.theta.setZero(static_cast<int>(parts.size()) - kTorsoDof);
    still.Reset(pose, PoseStep::Zero(pose.dof()));
    still.Predict(dt_s);
    variance_ = still.covariance().diagonal();
  }

  struct Cost {
    double nats = 0;
    bool jumps = false;
  };
  Cost Of(const PoseState& from, const PoseState& to) const {
    const PoseStep step = to.Minus(from);
    std::array<double, kMaxDof> of_part{};
    for (int i = 0; i < step.size(); ++i)
      of_part[static_cast<std::size_t>(parts_[i])] += step[i] * step[i] / variance_[i] / 2;
    Cost cost;
    for (const double nats : of_part) {
      cost.nats += std::min(nats, kJumpNats);
      cost.jumps |= nats >= kJumpNats;
    }
    return cost;
  }

 private:
  std::span<const int> parts_;
  PoseStep variance_;
};

// Adds probabilities that are given as -log p.
class SumOfNats {
 public:
  void Add(double nats) {
    const double least = std::min(least_, nats);
    sum_ = sum_ * std::exp(least - least_) + std::exp(least - nats);
    least_ = least;
  }
  double nats() const { return least_ - std::log(sum_); }

 private:
  double least_ = std::numeric_limits<double>::infinity();
  double sum_ = 0;
};

// A candidate on the way.
struct Node {
  double own = 0;   // -log p of the set.
  double best = 0;  // Of the best way up to here,
  double all = 0;   // and of all ways.
  double rest = 0;  // Of all ways from here on.
  int from = -1;    // Its candidate in the set before that has any; -1: it begins here.
  bool jumps = false;
};

// The candidates of a set that has any, and what they cost after those of the one before.
struct Stage {
  std::size_t set = 0;
  const Candidates* candidates = nullptr;
  std::vector<Node> nodes = {};
  std::vector<std::vector<double>> cost = {};  // By candidate before, then by candidate.
};

class PathFinder {
 public:
  PathFinder(std::span<const Candidates> sets, std::span<const double> dt_s, const BodyModel& body,
             const std::optional<PoseState>& before)
      : sets_(sets), body_(body), parts_(PartsOf(body.table())) {
    if (before) start_ = {Candidate{*before, 0, {}}};
    if (before) stages_.push_back({.candidates = &start_, .nodes = {Node{}}});
    for (std::size_t set = 0; set < sets.size(); ++set) {
      since_last_s_ += dt_s[set];
      if (sets[set].empty()) continue;
      Advance(set, FrameWorth(dt_s[set]));
      since_last_s_ = 0;
    }
    SumBackward();
  }

  std::vector<PathStep> Path() const {
    std::vector<PathStep> path(sets_.size());
    if (stages_.empty()) return path;
    const std::vector<Node>& last = stages_.back().nodes;
    auto chosen = static_cast<int>(std::ranges::min_element(last, {}, &Node::best) - last.begin());
    for (std::size_t k = stages_.size(); k-- > 0 && stages_[k].candidates != &start_;) {
      const Stage& stage = stages_[k];
      const auto i = static_cast<std::size_t>(chosen);
      const Candidate& candidate = (*stage.candidates)[i];
      path[stage.set] = {candidate.pose, candidate.things, stage.nodes[i].jumps,
                         ProbabilityOf(stage, i)};
      chosen = stage.nodes[i].from;
    }
    return path;
  }

 private:
  void Advance(std::size_t set, double worth) {
    Stage stage{.set = set, .candidates = &sets_[set]};
    const Stage* const before = stages_.empty() ? nullptr : &stages_.back();
    const MotionCost motion(parts_, since_last_s_);
    if (before) stage.cost.resize(before->nodes.size());
    for (const Candidate& candidate : sets_[set]) {
      Node node{.own = worth * candidate.nats};
      if (before) {
        Arrive(*before, candidate, motion, stage.cost, node);
      } else {
        node.best = node.all = node.own;
      }
      stage.nodes.push_back(node);
    }
    stages_.push_back(std::move(stage));
  }

  static void Arrive(const Stage& before, const Candidate& candidate, const MotionCost& motion,
                     std::vector<std::vector<double>>& cost, Node& node) {
    SumOfNats all;
    node.best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < before.nodes.size(); ++i) {
      const MotionCost::Cost step = motion.Of((*before.candidates)[i].pose, candidate.pose);
      cost[i].push_back(step.nats);
      all.Add(before.nodes[i].all + step.nats + node.own);
      const double nats = before.nodes[i].best + step.nats + node.own;
      if (nats >= node.best) continue;
      node.best = nats;
      node.from = static_cast<int>(i);
      node.jumps = step.jumps;
    }
    node.all = all.nats();
  }

  void SumBackward() {
    for (std::size_t k = stages_.size(); k-- > 1;) {
      const Stage& stage = stages_[k];
      for (std::size_t i = 0; i < stages_[k - 1].nodes.size(); ++i) {
        SumOfNats rest;
        for (std::size_t j = 0; j < stage.nodes.size(); ++j)
          rest.Add(stage.cost[i][j] + stage.nodes[j].own + stage.nodes[j].rest);
        stages_[k - 1].nodes[i].rest = rest.nats();
      }
    }
  }

  // Of a candidate's pose, whichever candidates have it.
  double ProbabilityOf(const Stage& stage, std::size_t chosen) const {
    SumOfNats same, all;
    const PoseState& pose = (*stage.candidates)[chosen].pose;
    for (std::size_t i = 0; i < stage.nodes.size(); ++i) {
      const double nats = stage.nodes[i].all + stage.nodes[i].rest;
      all.Add(nats);
      if (MeanDistance(body_, pose, body_, (*stage.candidates)[i].pose) < kOdds.same_mm)
        same.Add(nats);
    }
    return std::exp(all.nats() - same.nats());
  }

  std::span<const Candidates> sets_;
  const BodyModel& body_;
  const std::vector<int> parts_;
  Candidates start_;
  std::vector<Stage> stages_;
  double since_last_s_ = 0;
};

}  // namespace

std::vector<PathStep> LikeliestPath(std::span<const Candidates> sets, std::span<const double> dt_s,
                                    const BodyModel& body, const std::optional<PoseState>& before) {
  return PathFinder(sets, dt_s, body, before).Path();
}

}  // namespace mocap
