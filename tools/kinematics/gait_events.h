// Foot strikes and toe-offs of people who walk or run.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "core/geometry.h"
#include "tools/results/result.h"

namespace mocap {

enum class Side { kLeft = 0, kRight = 1 };
inline constexpr std::array<std::string_view, 2> kSideNames = {"left", "right"};

enum class GaitEventKind { kFootStrike, kFootOff };
inline constexpr std::array<std::string_view, 2> kGaitEventNames = {"Foot Strike", "Foot Off"};

struct GaitEvent {
  Side side;
  GaitEventKind kind;
  double time_s;  ///< Since the first frame, to a part of a frame.
};

/// What gait is measured by in one tracked frame.
struct GaitFrame {
  double time_s = 0;
  Vector3 pelvis_W = Vector3::Zero();  ///< Middle of the hip joints [mm].
  std::array<Vector3, 2> heel_W, toe_W;
};

/// Consecutive tracked frames, without a gap.
using GaitRun = std::vector<GaitFrame>;

/// Lists the runs of a result whose feet are known; those shorter than two seconds hold no stride.
std::vector<GaitRun> GaitRunsOf(const Result& result);

/// Horizontal direction of walking in every frame: that of the pelvis over half a second. Zero
/// while it moves slower than 0.2 m/s, less than people walk at.
std::vector<Vector3> DirectionsOf(std::span<const GaitFrame> run);

/// Finds the events of a run by the positions of heel and toe relative to the pelvis, along the
/// direction of walking: a foot strikes when its heel is farthest ahead, and leaves the floor when
/// its toe is farthest behind (Zeni, Richards and Higginson 2008). In order of time.
std::vector<GaitEvent> FindGaitEvents(std::span<const GaitFrame> run);

}  // namespace mocap
