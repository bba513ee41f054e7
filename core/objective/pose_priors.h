// Which poses and bodies are likely before the evidence is looked at.
#pragma once

#include <optional>

#include "core/body/body_model.h"
#include "core/body/update_equations.h"

namespace mocap {

/// -log p of the joint angles: normal about their rest, and hardly beyond their limits.
double JointNats(const BodyTable& table, const JointAngles& theta);
/// Adds its linearisation. An angle beyond its limit is measured to be at the limit, so that the
/// rest of the chain takes up the difference.
void LinearizeJoints(const BodyTable& table, const PoseState& pose, UpdateEquations& equations);

/// How far an upright trunk is turned against the feet: 0 to 1, the opposite way.
/// @param toes_W  where the feet point; empty: they show no direction, and the share is 0.
double ShareBackwards(const PoseState& pose, const std::optional<Vector3>& toes_W);

/// -log p of the trunk's orientation and of the body's stature: few people are upside down, turned
/// against their feet, or very tall.
double HabitNats(const BodyModel& body, const PoseState& pose,
                 const std::optional<Vector3>& toes_W);

}  // namespace mocap
