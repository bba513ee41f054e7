#include "core/proposals/limb_objective.h"

#include <algorithm>
#include <bit>

#include "core/hypotheses/pose_filter.h"

namespace mocap {
namespace {

// A limb may move this far from where it starts; the rest hardly moves.
struct LimbFreedom {
  double limb_rad = 0.5, rest_mm = 0.1, rest_rad = 1e-3;
  Iterations iterations{.usual = 5, .most = 5};
};
constexpr LimbFreedom kFreedom{};

void ListRows(const BodyTable& table, Segment limb_end, std::vector<int>& rows) {
  const int trunk = table.carrier[static_cast<int>(Segment::kPelvis)];
  rows.clear();
  for (int i = table.carrier[static_cast<int>(limb_end)]; i >= 0 && i != trunk;
       i = table.joints[i].parent)
    rows.push_back(i);
  std::ranges::reverse(rows);
}

CapsuleSet CapsulesOf(const BodyModel& body, const std::vector<int>& rows) {
  CapsuleSet capsules = 0;
  for (int i = 0; i < std::ssize(body.shape()); ++i)
    if (std::ranges::find(rows, body.shape()[i].carrier) != rows.end())
      capsules |= CapsuleSet{1} << i;
  return capsules;
}

}  // namespace

void LimbObjective::Begin(Objective& whole, const BodyModel& body, const PoseState& pose,
                          Segment limb_end, Segment absent, const Things& things) {
  whole_ = &whole;
  ListRows(body.table(), limb_end, rows_);
  ListRows(body.table(), absent, absent_rows_);
  limb_.posed.Set(body, pose);
  limb_.moving = CapsulesOf(body, rows_);
  limb_.present = limb_.moving | ~CapsulesOf(body, absent_rows_);
  limb_.contacts.TakeOpen(whole.contacts(), limb_.posed, limb_.moving, ~limb_.present, things);
}

double LimbObjective::At(const PoseState& pose) {
  limb_.posed.Move(pose, rows_);
  return whole_->At(limb_, {}).Sum();
}

double LimbObjective::FleshAt(const PoseState& pose) {
  limb_.posed.Move(pose, rows_);
  return whole_->flesh().At(limb_.posed, limb_.moving);
}

void LimbObjective::Refine(PoseState& pose) {
  PoseFilter filter{MotionNoise{}};
  PoseStep std = PoseStep::Constant(pose.dof(), kFreedom.rest_rad);
  std.head<3>().setConstant(kFreedom.rest_mm);
  for (const int row : rows_) std[kTorsoDof + row] = kFreedom.limb_rad;
  filter.Reset(pose, std);
  filter.Draw(
      [this](const PoseState& at, UpdateEquations& equations) {
        limb_.posed.Move(at, rows_);
        whole_->Linearize(limb_, {}, equations);
      },
      kFreedom.iterations);
  for (const int row : rows_) pose.theta[row] = filter.pose().theta[row];
}

Vector3 LimbObjective::TipAt(const PoseState& pose) {
  limb_.posed.Move(pose, rows_);
  return limb_.posed.capsules()[std::bit_width(limb_.moving) - 1].b_W;
}

}  // namespace mocap
