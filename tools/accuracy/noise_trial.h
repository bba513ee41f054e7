// Measures the noise of the evidence: residuals at the true poses of simulated people, and what
// right and wrong poses cost.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/objective/residual_noise.h"
#include "tools/accuracy/accuracy_trial.h"
#include "tools/accuracy/contact_fit.h"
#include "tools/accuracy/odds_fit.h"

namespace mocap {

/// The terms of the objective that have residuals.
enum class NoiseKind { kSurface, kRay, kBorder, kFlesh, kOverlap, kFloor };
inline constexpr std::array<std::string_view, 6> kNoiseKindNames = {"surface", "ray",     "border",
                                                                    "flesh",   "overlap", "floor"};

/// The residuals of one kind at one part of a body, in one frame set. Places of bones that are in
/// flesh and not in other parts have a residual of 0.
struct ResidualGroup {
  NoiseKind kind;
  int capsule = 0;
  int set = 0;  ///< Counts the measured sets of the take.
  std::vector<float> residuals_mm;
};

/// What one take shows.
struct NoiseTake {
  std::vector<ResidualGroup> groups;
  OddsTake odds;         ///< Of one set a second.
  ContactTake contacts;  ///< Of all sets.
  double step_s = 0;     ///< Between measured sets.
  double voxel_mm = 0;
  int sets = 0, left_out = 0;  ///< Measured; and those where the body cannot take the true pose.
};

/// Tracks a take, so that the body has the sizes that tracking gives it. Compares that body with
/// the evidence where the true joints are, and where a search among stances finds it.
NoiseTake RunNoiseTrial(const AccuracyTrial& trial);

/// Noise of one kind.
struct MeasuredNoise {
  ResidualNoise noise;
  double residuals = 0;  ///< Their number.
  /// Of bones: those at least half a voxel outside of flesh or in other parts. 1 for other kinds.
  double far_share = 1;
  double correlation = 0;  ///< Of a part's residuals, between measured sets.
  /// Mean -log p of one residual in other people, by this noise and by their own [nats].
  double others_nats = 0, own_nats = 0;
};

/// Fits the noise as FitResiduals does, and how many residuals count as one from the spread of the
/// parts' means of derivatives of -log p. The takes at even places are fitted, the others check.
/// @param takes  at least two, with residuals of that kind.
MeasuredNoise FitNoise(std::span<const NoiseTake> takes, NoiseKind kind);

/// Tables of all kinds, of contacts and of the odds.
std::string NoiseTable(std::span<const NoiseTake> takes);

}  // namespace mocap
