// The body as it is drawn: what stands in messages and results, as capsules.
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
  /// @param record  of a model that is built in, or of another one, which is drawn more simply.
  explicit DrawnBody(const BodyRecord& record);

  const BodyRecord& record() const { return record_; }
  /// Whether it is drawn from the same sizes.
  bool IsOf(const BodyRecord& record) const {
    return record_.model == record.model && record_.sizes == record.sizes;
  }
  /// The part that each capsule belongs to, where every joint is known.
  const std::vector<int>& parts() const { return parts_; }
  /// The flesh as the tracker has it.
  /// @return  that of CapsulesFromPoints where the pose is of another model.
  std::vector<PosedCapsule> Pose(const pose_t& pose, const PoseRow& row) const;

 private:
  BodyRecord record_;
  std::optional<BodyModel> model_;
  std::vector<int> parts_;
};

/// Ten parts between the 23 points, where joint angles are not known.
std::vector<PosedCapsule> CapsulesFromPoints(const PoseRow& row, const BodySizes& sizes);
/// The part of each of those.
const std::vector<int>& PartsFromPoints();

/// JSON of a body for the page: model, sizes, names, sticks, the capsules' parts.
std::string BodyJson(const BodyRecord& record, const std::vector<int>& parts);

}  // namespace mocap
