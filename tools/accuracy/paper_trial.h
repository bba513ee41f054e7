// One simulated person, followed by the paper's tracker with truth in place of some of its stages.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/evaluation/accuracy.h"
#include "core/reconstruction/carving/voxel_grid.h"
#include "drivers/virtual_studio/studio_options.h"

namespace mocap {

/// What is replaced by truth.
enum class PaperTruth { kNothing, kStart, kStartAndParts };
inline constexpr std::array<std::string_view, 3> kPaperTruthNames = {
    "nothing", "sizes and first pose", "and the part of each voxel of the limbs"};

/// The rates: every frame, and every third.
inline constexpr std::array<int, 2> kPaperSteps = {1, 3};

/// A person as the tracker gets him, with truth.
struct CarvedTake {
  struct Frame {
    std::int64_t capture_ns = 0;
    VoxelGrid flesh;
    ScoredPoints truth_W = ScoredPoints::Zero();
  };
  std::string motion;
  double stature_mm = 0;
  std::uint64_t seed = 0;
  std::vector<Frame> frames;
};

/// Simulates a take of a single person and carves its frames as the daemon does.
/// @throws SetupError  for invalid studio options.
CarvedTake CarveTake(const SimulatedStudioOptions& studio);

/// How well a person was followed; errors over the tracked frames.
struct PaperScore {
  bool acquired = false;  ///< Tracked in any frame; otherwise there are no errors.
  double mean_mm = 0, median_mm = 0;
  double head_share = 0;     ///< Head within kHeadFoundMm.
  double tracked_share = 0;  ///< Of the frames from the first second on.
};

/// Follows the person of a take, in every frame or each `step`-th.
PaperScore ScoreTake(const CarvedTake& take, int step, PaperTruth truth);

/// All scores of one take.
struct PaperRow {
  std::string motion;
  double stature_mm = 0;
  std::uint64_t seed = 0;
  /// By PaperTruth, then by kPaperSteps.
  std::array<std::array<PaperScore, kPaperSteps.size()>, kPaperTruthNames.size()> scores = {};
};

/// Simulates and carves a take once, and scores it in all ways. The same options give the same row.
/// @throws SetupError  for invalid studio options.
PaperRow RunPaperTrial(const SimulatedStudioOptions& studio);

}  // namespace mocap
