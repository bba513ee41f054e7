// Foot strikes and toe-offs of people who walk or run.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "core/geometry.h"
#include "tools/results/result.h"

namespace mocap {

enum class Side { kLeft = 0, kRight = 1 };
inline constexpr std::array<std::string_view, 2> kSideNames = {"left", "right"};

inline std::string_view NameOf(Side side) { return kSideNames[static_cast<std::size_t>(side)]; }

enum class GaitEventKind { kFootStrike, kFootOff };
/// As C3D files have them.
inline constexpr std::array<std::string_view, 2> kGaitEventNames = {"Foot Strike", "Foot Off"};
inline std::string_view NameOf(GaitEventKind kind) {
  return kGaitEventNames[static_cast<std::size_t>(kind)];
}

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
  /// How likely any of a foot touches the floor, 0 to 1; NaN: not known.
  std::array<double, 2> contact = {std::numeric_limits<double>::quiet_NaN(),
                                   std::numeric_limits<double>::quiet_NaN()};
};

/// Consecutive tracked frames, without a gap.
using GaitRun = std::vector<GaitFrame>;

/// Who moves slower does not walk [mm/s]: half the speed of who walks at home only after a stroke
/// (0.4 m/s, Perry et al. 1995).
inline constexpr double kLeastWalking_mm_s = 200;

/// Whether a row has the heels and toes of both feet.
bool HasFeet(const PoseRow& row);

/// Whether any frame of a result tells contacts of both feet.
bool HasContacts(const Result& result);

/// Lists the runs of tracked frames with feet. Where a result has contacts, frames without them are
/// left out: the first frame after somebody was found has none.
std::vector<GaitRun> GaitRunsOf(const Result& result);

/// Horizontal direction of walking in every frame: that of the pelvis over half a second. Zero
/// while it moves slower than kLeastWalking_mm_s.
std::vector<Vector3> DirectionsOf(std::span<const GaitFrame> run);

/// Finds the events of a run by contact: a foot strikes when the first of heel and toe touches the
/// floor, and leaves it with the last, each when its probability crosses a half. Contacts and gaps
/// shorter than 0.08 s are left out: the shortest that sprinters' feet take are 0.09 s (Weyand et
/// al. 2000). In order of time.
/// @pre  all frames have contacts.
std::vector<GaitEvent> FindContactEvents(std::span<const GaitFrame> run);

/// Finds the events of a run by the positions of heel and toe relative to the pelvis, along the
/// direction of walking: a foot strikes when its heel is farthest ahead, and leaves the floor when
/// its toe is farthest behind (Zeni, Richards and Higginson 2008). In order of time.
std::vector<GaitEvent> FindPositionEvents(std::span<const GaitFrame> run);

/// Finds the events of a run by contact if its result has contacts, or else by position.
std::vector<GaitEvent> FindGaitEvents(std::span<const GaitFrame> run);

/// Finds the events of all runs, in order of time.
std::vector<GaitEvent> GaitEventsOf(const Result& result);

}  // namespace mocap
