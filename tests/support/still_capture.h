// Somebody whose pose does not change.
#pragma once

#include "core/motion_capture.h"

namespace mocap::testing {

class StillCapture : public MotionCapture {
 public:
  StillCapture(const BodyModel& body, const CaptureResult& result) : body_(body), result_(result) {}

  const CaptureResult& Update(const Observation&, std::int64_t, UpdateObserver*) override {
    return result_;
  }
  void Forget() override {}
  void Expect(const BodySizes&) override {}
  const CaptureResult& result() const override { return result_; }
  PoseState PredictedPose(std::int64_t) const override { return result_.pose; }
  const BodyModel& body() const override { return body_; }
  int acquisition_frames() const override { return 1; }

 private:
  BodyModel body_;
  CaptureResult result_;
};

}  // namespace mocap::testing
