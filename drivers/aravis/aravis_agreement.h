// Configures a camera as requested, and reads back the result.
#pragma once

#include <arv.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/aravis/aravis_formats.h"
#include "drivers/aravis/aravis_settings.h"
#include "drivers/camera_request.h"

namespace mocap {

struct AravisAgreement {
  std::string model, serial;
  AravisFormat format = kAravisFormats.back();
  int width_px = 0, height_px = 0;
  std::size_t payload_bytes = 0;  ///< Size of a whole frame.
  double fps = 0;
  std::int64_t exposure_ns = 0;
  bool has_stamps = false;
  std::string ptp_status;            ///< Name of the feature with the state; empty: no PTP.
  std::vector<std::string> remarks;  ///< Deviations from what was requested.
};

/// Configures a camera.
/// @throws SetupError  for required settings that fail: size, format, trigger, strobe.
AravisAgreement Agree(ArvCamera* camera, const CameraRequest& request,
                      const AravisSettings& settings);

}  // namespace mocap
