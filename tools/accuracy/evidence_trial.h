// Simulated takes of weak evidence: clothes like the wall, and pictures after lossy coding.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "drivers/virtual_studio/studio_options.h"
#include "tools/accuracy/accuracy_benchmark.h"

namespace mocap {

/// What makes evidence weak, and how many cameras give it.
struct EvidenceKind {
  double contrast = 0;          ///< As in SimulatedStudioOptions,
  std::optional<int> crf = {};  ///< this,
  int cameras = 0;              ///< this,
  double misled_share = 0;      ///< this,
  bool soft_shadows = false;    ///< and this.
  friend bool operator==(const EvidenceKind&, const EvidenceKind&) = default;
};

inline constexpr std::array<double, 4> kEvidenceContrasts = {40, 20, 15, 10};
inline constexpr std::array<std::optional<int>, 3> kEvidenceCrfs = {std::nullopt, 18, 28};
inline constexpr std::array<int, 3> kEvidenceCameras = {4, 8, 16};
/// One of four cameras and of eight, and two of sixteen.
inline constexpr double kEvidenceMisled = 0.1;

/// Lists all combinations: cameras change first, then crf. Then clothes of full contrast with soft
/// shadows, and with misled cameras, in pictures without loss.
std::vector<EvidenceKind> PlannedEvidence();

/// Makes a studio one of this kind.
void ApplyEvidence(const EvidenceKind& kind, SimulatedStudioOptions& studio);

/// One take.
struct EvidenceRow {
  EvidenceKind kind;
  AccuracyRow accuracy;
  /// Volume of the carved hull, as a share of that of the hull of the same cameras' true masks.
  /// Both are summed over the frame sets.
  double hull_share = 0;
  /// Share of unknown pixels where cameras show the person, as `mocap status` has it; the mean over
  /// cameras.
  double unknown_share = 0;
};

/// Simulates a take and tracks it. The same options give the same row.
/// @throws SetupError  for invalid studio options.
EvidenceRow RunEvidenceTrial(const SimulatedStudioOptions& studio);

}  // namespace mocap
