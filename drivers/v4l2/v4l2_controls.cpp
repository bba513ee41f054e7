#include "drivers/v4l2/v4l2_controls.h"

#include <linux/videodev2.h>

#include <cmath>
#include <optional>
#include <sstream>

namespace mocap {
namespace {

constexpr double kExposureUnit_us = 100;

/// A control that a camera may also adjust automatically.
struct Knob {
  const char* key;  ///< Configuration key.
  std::uint32_t id;
  double unit;              ///< One step of the control, in the key's unit.
  std::uint32_t automatic;  ///< The control that selects automatic mode,
  int manual;               ///< and its value for manual mode.
};

constexpr Knob kExposure{"exposure_us", V4L2_CID_EXPOSURE_ABSOLUTE, kExposureUnit_us,
                         V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL};
constexpr Knob kGain{"gain", V4L2_CID_GAIN, 1, V4L2_CID_AUTOGAIN, 0};
constexpr Knob kWhiteBalance{"white_balance_k", V4L2_CID_WHITE_BALANCE_TEMPERATURE, 1,
                             V4L2_CID_AUTO_WHITE_BALANCE, 0};
constexpr Knob kFocus{"focus", V4L2_CID_FOCUS_ABSOLUTE, 1, V4L2_CID_FOCUS_AUTO, 0};

class Controls {
 public:
  Controls(VideoKernel& kernel, int handle, std::vector<std::string>& remarks)
      : kernel_(kernel), handle_(handle), remarks_(remarks) {}

  std::optional<int> Get(std::uint32_t id) const {
    v4l2_control control{};
    control.id = id;
    if (kernel_.Request(handle_, VIDIOC_G_CTRL, &control) < 0) return std::nullopt;
    return control.value;
  }

  void Turn(const Knob& knob, std::optional<double> wanted) {
    const std::optional<int> automatic = Get(knob.automatic);
    if (!wanted) {
      if (automatic && *automatic != knob.manual) {
        Remark(std::string(knob.key) + ": the camera adjusts it automatically; set " + knob.key);
      }
      return;
    }
    if (automatic) Set(knob.automatic, knob.manual);
    const int steps = static_cast<int>(std::lround(*wanted / knob.unit));
    const std::optional<int> got = Set(knob.id, steps);
    if (!got) {
      Remark(std::string(knob.key) + ": the camera has no such control");
    } else if (*got != steps) {
      Remark(std::string(knob.key) + ": requested " + Shown(*wanted) + ", the camera set " +
             Shown(*got * knob.unit) + RangeOf(knob));
    }
  }

  /// Sets a control and reads it back; empty: it does not exist.
  std::optional<int> Set(std::uint32_t id, int value) {
    v4l2_control control{};
    control.id = id;
    control.value = value;
    kernel_.Request(handle_, VIDIOC_S_CTRL, &control);
    return Get(id);
  }

  void Remark(const std::string& remark) { remarks_.push_back(remark); }

 private:
  static std::string Shown(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
  }

  std::string RangeOf(const Knob& knob) const {
    v4l2_queryctrl query{};
    query.id = knob.id;
    if (kernel_.Request(handle_, VIDIOC_QUERYCTRL, &query) < 0) return "";
    return "; its range is " + Shown(query.minimum * knob.unit) + " to " +
           Shown(query.maximum * knob.unit);
  }

  VideoKernel& kernel_;
  const int handle_;
  std::vector<std::string>& remarks_;
};

void SetPowerLine(Controls& controls, int hz) {
  const int wanted = hz == 50   ? V4L2_CID_POWER_LINE_FREQUENCY_50HZ
                     : hz == 60 ? V4L2_CID_POWER_LINE_FREQUENCY_60HZ
                                : V4L2_CID_POWER_LINE_FREQUENCY_DISABLED;
  const std::optional<int> got = controls.Set(V4L2_CID_POWER_LINE_FREQUENCY, wanted);
  if (!got) {
    controls.Remark("power_line_hz: the camera has no such control");
  } else if (*got != wanted) {
    controls.Remark("power_line_hz: the camera does not take " + std::to_string(hz));
  }
}

}  // namespace

std::int64_t SetControls(VideoKernel& kernel, int handle, const V4l2Settings& settings,
                         std::vector<std::string>& remarks) {
  Controls controls(kernel, handle, remarks);
  if (controls.Set(V4L2_CID_EXPOSURE_AUTO_PRIORITY, 0).value_or(0) != 0) {
    controls.Remark("the camera lowers its frame rate in the dark; set exposure_us");
  }
  controls.Turn(kExposure, settings.exposure_us);
  controls.Turn(kGain, settings.gain);
  controls.Turn(kWhiteBalance, settings.white_balance_k);
  controls.Turn(kFocus, settings.focus);
  if (settings.power_line_hz) SetPowerLine(controls, *settings.power_line_hz);

  const bool is_constant = controls.Get(kExposure.automatic) == kExposure.manual;
  const std::optional<int> steps = controls.Get(kExposure.id);
  if (!is_constant || !steps) return 0;
  return static_cast<std::int64_t>(*steps) * static_cast<std::int64_t>(kExposureUnit_us * 1000);
}

}  // namespace mocap
