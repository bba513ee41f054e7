// What the log tells: changes, not the course of things.
#pragma once

#include <optional>

#include "daemon/pipeline.h"

namespace mocap {

/// Logs how a status differs from the one before: the state, cameras that go and come back, sets
/// that begin to be dropped.
class ChangeLog {
 public:
  void Add(const PipelineStatus& status);

 private:
  void CompareCameras(const PipelineStatus& before, const PipelineStatus& now);

  std::optional<PipelineStatus> last_;
  bool is_behind_ = false;
};

}  // namespace mocap
