#include "tools/results/message_body.h"

#include <algorithm>

#include "config/body_size_fields.h"
#include "config/builtin_body_tables.h"
#include "config/load_config.h"

namespace mocap {
namespace {

constexpr double kLongestPart_mm = 3000;

bool IsBuiltIn(const std::string& model) {
  return std::ranges::any_of(BuiltinBodyTables(),
                             [&](const BuiltinBodyTable& table) { return table.name == model; });
}

}  // namespace

bool AreSizes(const BodySizes& sizes) {
  return std::ranges::all_of(kBodySizeFields, [&](const BodySizeField& field) {
    const double size = sizes.*field.value;
    return size > 0 && size < kLongestPart_mm;
  });
}

std::optional<BodyModel> ModelOf(const BodyRecord& record) {
  // Messages must not cause file reads.
  if (!IsBuiltIn(record.model) || !AreSizes(record.sizes)) return {};
  return BodyModel(LoadBodyTable(record.model), record.sizes);
}

PoseState StateOf(const pose_t& pose) {
  PoseState state;
  state.X_WT.R = ExpRotation(Vector3(pose.torso_axis) * pose.torso_angle_rad);
  state.X_WT.p = Vector3(pose.torso_mm);
  state.theta.resize(pose.num_joints);
  std::ranges::copy(pose.joint_rad, state.theta.begin());
  return state;
}

}  // namespace mocap
