// Measures the noise of the evidence: residuals at the true poses of simulated people.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/tracking/surface_fit.h"
#include "tools/accuracy/accuracy_trial.h"
#include "tools/accuracy/residual_noise.h"

namespace mocap {

inline constexpr std::array<std::string_view, 3> kResidualKindNames = {"surface", "ray", "border"};

/// The residuals of one kind at one part of a body, in one frame set.
struct ResidualGroup {
  ResidualKind kind;
  int capsule = 0;
  int set = 0;  ///< Counts the measured sets of the take.
  std::vector<float> residuals_mm;
};

/// What one take shows.
struct NoiseTake {
  std::vector<ResidualGroup> groups;
  double step_s = 0;           ///< Between measured sets.
  int sets = 0, left_out = 0;  ///< Measured; and those where the body cannot take the true pose.
};

/// Tracks a take, so that the body has the sizes that tracking gives it. Compares that body with
/// the evidence where the true joints are.
NoiseTake RunNoiseTrial(const AccuracyTrial& trial);

/// Noise of one kind.
struct MeasuredNoise {
  ResidualNoise noise;
  double residuals = 0;
  double correlation = 0;  ///< Of a part's mean residuals, between measured sets.
  /// Mean -log p of one residual in other people, by this noise and by their own [nats].
  double others_nats = 0, own_nats = 0;
};

/// Fits sigma and share of outliers by maximum likelihood (expectation maximization), and the share
/// of independent residuals from the spread of the parts' means. The takes at even places are
/// fitted, the others check.
/// @param takes  at least two, with residuals of that kind.
MeasuredNoise FitNoise(std::span<const NoiseTake> takes, ResidualKind kind);

/// A table of all kinds.
std::string NoiseTable(std::span<const NoiseTake> takes);

}  // namespace mocap
