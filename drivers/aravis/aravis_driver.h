// Driver for GigE Vision and USB3 Vision cameras, through Aravis.
#pragma once

#include <memory>
#include <optional>

#include "drivers/aravis/aravis_settings.h"
#include "drivers/camera_driver.h"
#include "drivers/camera_request.h"
#include "drivers/capture_clock.h"
#include "drivers/frame_counter.h"
#include "drivers/pixels/pixel_format.h"

struct _ArvBuffer;

namespace mocap {

class AravisKeeper;
class AravisSession;

/// Delivers frames directly from the receive buffers; every format except BGR8 is converted. A
/// silent camera counts as lost and is reopened as soon as it answers. Grab never waits for it
/// beyond its timeout.
class AravisDriver : public CameraDriver {
 public:
  AravisDriver(const CameraRequest& request, const AravisSettings& settings);
  ~AravisDriver() override;

  void Start() override;
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) override;
  void Stop() override;
  CameraFacts Facts() const override;

 private:
  void FollowKeeper();
  void GiveBack();
  std::optional<GrabStatus> Take(_ArvBuffer* buffer, Frame& frame);
  bool IsWhole(_ArvBuffer* buffer) const;
  bool ReadPixels(_ArvBuffer* buffer, Frame& frame);

  const CameraRequest request_;
  const AravisSettings settings_;
  std::shared_ptr<AravisKeeper> keeper_;    ///< Null when stopped.
  std::shared_ptr<AravisKeeper> previous_;  ///< May still be closing the camera.
  std::shared_ptr<AravisSession> session_;
  unsigned generation_ = 0;
  bool fresh_ = false;          ///< No whole frame yet in this session.
  _ArvBuffer* lent_ = nullptr;  ///< The buffer whose pixels are lent.
  std::optional<CaptureClock> clock_;
  FrameCounter counter_;
  PixelConverter converter_;
  Image<Bgr> picture_;
};

}  // namespace mocap
