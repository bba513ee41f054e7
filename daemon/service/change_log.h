// Logs changes of the status.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "daemon/pipeline/frame_path.h"

namespace mocap {

/// Logs how a status differs from the previous one: the state, cameras lost and back, remarks of
/// their drivers, sets being dropped.
class ChangeLog {
 public:
  void Add(const PipelineStatus& status);

 private:
  void TellRemarks(const CameraStatus& camera);
  void CompareCameras(const PipelineStatus& before, const PipelineStatus& now);

  /// Calls without a drop after which the overload counts as over.
  static constexpr int kCallsToRecover = 50;

  std::optional<PipelineStatus> last_;
  int calls_since_drop_ = kCallsToRecover;  ///< Or more.
  std::set<std::string> told_;
};

}  // namespace mocap
