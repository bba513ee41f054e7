// What differences of -log p are worth: how often the pose with the fewest nats is right.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/objective/objective.h"

namespace mocap {

/// -log p of right and of wrong poses of one person in one frame set, term by term.
struct OddsFrame {
  using Nats = std::array<double, kTermNames.size()>;
  std::vector<Nats> right, wrong;  ///< Neither is empty.
};
using OddsTake = std::vector<OddsFrame>;

/// The odds by exp(-T nats), and how often they are right. The right pose of a set is the right one
/// with the fewest nats.
struct MeasuredOdds {
  int frames = 0;
  double right_share = 0;       ///< The right pose has fewer nats than all wrong ones.
  double median_lead_nats = 0;  ///< Of the right pose before the best wrong one.
  double temperature = 0;       ///< T with the greatest likelihood.
  /// Mean -log p of the right pose in other people, by this factor and by their own [nats].
  double others_nats = 0, own_nats = 0;

  /// Sets of the other people by the probability of their likeliest pose.
  struct Bin {
    double from = 0, to = 0;
    int frames = 0;
    double predicted = 0, right_share = 0;  ///< Mean probability; share where that pose is right.
  };
  std::array<Bin, 2> bins = {{{0.5, 0.9}, {0.9, 1}}};
  std::array<double, kTermNames.size()> right_share_without{};  ///< If a term is left out.
};

/// Measures the odds. T is fitted to the takes at even places; the others check.
/// @param takes  at least two, each with frames at even and odd places among them.
MeasuredOdds FitOdds(std::span<const OddsTake> takes);

/// Tables of the odds; empty without frames for both halves.
std::string OddsTables(std::span<const OddsTake> takes);

}  // namespace mocap
