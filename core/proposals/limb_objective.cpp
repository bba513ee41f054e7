#include "core/proposals/limb_objective.h"

#include <algorithm>

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
  posed_.Set(body, pose);
  moving_ = CapsulesOf(body, rows_);
  present_ = moving_ | ~CapsulesOf(body, absent_rows_);
  open_.TakeOpen(whole.contacts(), posed_, moving_, ~present_, things);
}

double LimbObjective::At(const PoseState& pose) {
  whole_->Count(static_cast<int>(open_.contacts().size()));
  posed_.Move(pose, rows_);
  const ContactNats contacts = open_.At(posed_, {});
  return contacts.rays + contacts.surface + whole_->borders().At(posed_, moving_) +
         whole_->flesh().At(posed_, moving_ & ~open_.CarvedAway()) +
         OverlapTerm{}.At(posed_, moving_, present_) + JointNats(posed_.body().table(), pose.theta);
}

double LimbObjective::FleshAt(const PoseState& pose) {
  posed_.Move(pose, rows_);
  return whole_->flesh().At(posed_, moving_);
}

void LimbObjective::Linearize(const PoseState& pose, UpdateEquations& equations) {
  whole_->Count(static_cast<int>(open_.contacts().size()));
  posed_.Move(pose, rows_);
  chain_.Reset(posed_.body().table(), posed_.posture());
  Linearisation sums{chain_, equations};
  open_.Linearize(posed_, {}, sums);
  whole_->borders().Linearize(posed_, moving_, sums);
  whole_->flesh().Linearize(posed_, moving_ & ~open_.CarvedAway(), sums);
  chain_.AddTo(equations);
  OverlapTerm{}.Linearize(posed_, moving_, present_, sums);
  LinearizeJoints(posed_.body().table(), pose, equations);
}

void LimbObjective::Refine(PoseState& pose) {
  PoseFilter filter{MotionNoise{}};
  PoseStep std = PoseStep::Constant(pose.dof(), kFreedom.rest_rad);
  std.head<3>().setConstant(kFreedom.rest_mm);
  for (const int row : rows_) std[kTorsoDof + row] = kFreedom.limb_rad;
  filter.Reset(pose, std);
  filter.Draw([this](const PoseState& at, UpdateEquations& equations) { Linearize(at, equations); },
              kFreedom.iterations);
  for (const int row : rows_) pose.theta[row] = filter.pose().theta[row];
}

Vector3 LimbObjective::TipAt(const PoseState& pose) {
  posed_.Move(pose, rows_);
  int last = 0;
  for (int i = 0; i < std::ssize(posed_.capsules()); ++i)
    if (moving_ >> i & 1) last = i;
  return posed_.capsules()[last].b_W;
}

}  // namespace mocap
