// The body of a message or result as capsules, for drawing.
#pragma once

#include <memory>
#include <mocap/pose_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/body/body_model.h"
#include "tools/results/result.h"

namespace mocap {

/// A person's body with sizes.
class DrawnBody {
 public:
  /// @param record  if its model is not built in, the body is drawn more simply.
  explicit DrawnBody(const BodyRecord& record);

  const BodyRecord& record() const { return record_; }
  /// Whether it has the same model and sizes.
  bool IsOf(const BodyRecord& record) const {
    return record_.model == record.model && record_.sizes == record.sizes;
  }
  /// The part of each capsule, if every joint is known.
  const std::vector<int>& parts() const { return parts_; }
  /// Returns the tracker's capsules, posed.
  /// @return  those of CapsulesFromPoints if the pose is of another model.
  std::vector<PosedCapsule> Pose(const pose_t& pose, const PoseRow& row) const;

 private:
  BodyRecord record_;
  std::optional<BodyModel> model_;
  std::vector<int> parts_;
};

/// Capsules of the ten parts between the 23 points, for unknown joint angles.
std::vector<PosedCapsule> CapsulesFromPoints(const PoseRow& row, const BodySizes& sizes);
/// The part of each of these capsules.
const std::vector<int>& PartsFromPoints();

/// JSON of a body for the page: model, sizes, names, sticks, the capsules' parts.
std::string BodyJson(const BodyRecord& record, const std::vector<int>& parts);

}  // namespace mocap
