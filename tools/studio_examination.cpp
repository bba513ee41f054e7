#include "tools/studio_examination.h"

#include "core/calibration/diagnosis_text.h"

namespace mocap {

std::vector<SeenMoment> MomentsOf(const TakeSamples& samples,
                                  const std::vector<CameraCalibration>& cameras) {
  std::vector<SeenMoment> moments;
  for (const SampledMoment& sampled : samples.moments) {
    SeenMoment& moment = moments.emplace_back(cameras.size());
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      if (!sampled.views[c]) continue;
      const RigidTransform X_CW = PoseNow(samples.cameras[c], cameras[c], sampled.views[c]->X_CW);
      moment[c] = ShapeOf(sampled.views[c]->trimap.person, X_CW);
    }
  }
  return moments;
}

std::optional<Finding> ExamineStudio(const TakeSamples& samples) {
  const StudioDiagnosis diagnosis = Diagnose(samples.cameras, MomentsOf(samples));
  return IsOfCameras(diagnosis.fault) ? FindingOf(diagnosis, samples.cameras) : std::nullopt;
}

}  // namespace mocap
