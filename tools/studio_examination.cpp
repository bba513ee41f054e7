#include "tools/studio_examination.h"

#include <cstdio>

#include "core/calibration/diagnosis_text.h"
#include "drivers/printable_text.h"

namespace mocap {

std::vector<SeenMoment> MomentsOf(const TakeSamples& samples,
                                  const std::vector<CameraCalibration>& cameras) {
  std::vector<SeenMoment> moments;
  for (const SampledMoment& sampled : samples.moments) {
    SeenMoment& moment = moments.emplace_back(cameras.size());
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      if (!sampled.views[c]) continue;
      // A rotation in the camera's own frame does not depend on its head's angles.
      const RigidTransform X_CW =
          cameras[c].X_CW * samples.cameras[c].X_CW.Inverse() * sampled.views[c]->X_CW;
      moment[c] = ShapeOf(sampled.views[c]->silhouette, X_CW);
    }
  }
  return moments;
}

std::optional<Finding> ExamineStudio(const TakeSamples& samples) {
  const auto finding = FindingOf(Diagnose(samples.cameras, MomentsOf(samples)), samples.cameras);
  // Things that are no person may be all that is seen.
  return finding && finding->severity == Severity::kWrong ? finding : std::nullopt;
}

void TellRemarks(const std::string& command, const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) {
    std::fprintf(stderr, "mocap %s: %s\n", command.c_str(), Printable(remark).c_str());
  }
}

}  // namespace mocap
