// Figs. 1, 4 and 9: the paper's loop of acquisition and tracking.
#pragma once

#include <memory>

#include "core/motion_capture.h"

namespace mocap::mikic2003 {

/// "Usually several iterations of the extended Kalman filter algorithm are performed in each
/// frame": each labels the limbs by the pose that the one before has found.
inline constexpr int kPasses = 3;

/// The paper does not define loss of track. Here a person is lost while the measured points are so
/// far from the body's in the mean; §8.1 reports lengths that vary by 75 to 100 mm. Somebody who is
/// lost is located again as in the first frame, and forgotten after a time.
inline constexpr double kLostResidualMm = 80;
inline constexpr double kForgottenAfterS = 1;

/// Checks that a table has exactly the sixteen axes of the paper's Table 1. @throws SetupError
void RequirePaperAxes(const BodyTable& table);

/// Tracks a person as Mikić, Trivedi, Hunter and Cosman (2003) do: by labelled voxels alone,
/// without outlines.
class MikicCapture : public MotionCapture {
 public:
  /// @pre RequirePaperAxes(table) holds.
  explicit MikicCapture(const BodyTable& table);
  ~MikicCapture() override;

  const CaptureResult& Update(const Observation& observation, std::int64_t capture_ns,
                              UpdateObserver* observer) override;
  void Forget() override;
  void Expect(const BodySizes& sizes) override;
  const CaptureResult& result() const override;
  PoseState PredictedPose(std::int64_t capture_ns) const override;
  const BodyModel& body() const override;
  int acquisition_frames() const override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap::mikic2003
