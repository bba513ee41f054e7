#include "drivers/aravis/aravis_agreement.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include "core/errors.h"
#include "drivers/aravis/aravis_triggers.h"
#include "drivers/aravis/gobject.h"
#include "drivers/quoted.h"

namespace mocap {
namespace {

/// Tolerance, as cameras round to their own steps.
constexpr double kSame = 0.01;

std::string Number(double value) {
  std::string text = std::to_string(std::round(value * 1000) / 1000);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

bool Differs(double got, double wanted) {
  return std::abs(got - wanted) > kSame * std::max(std::abs(wanted), 1.0);
}

class Negotiation {
 public:
  Negotiation(ArvCamera* camera, const CameraRequest& request, const AravisSettings& settings)
      : camera_(camera), request_(request), settings_(settings) {}

  AravisAgreement Conclude() {
    const char* model = arv_camera_get_model_name(camera_, nullptr);
    const char* serial = arv_camera_get_device_serial_number(camera_, nullptr);
    agreed_.model = model ? model : "";
    agreed_.serial = serial ? serial : "";
    SetSize();
    SetFormat();
    SetRate();
    SetPtp();
    if (settings_.is_scheduled()) RequirePtp();
    SetTrigger(camera_, request_.device, settings_.trigger);
    SetStrobe(camera_, request_.device, settings_.strobe);
    SetExposure();
    SetGain();
    GFailure failure;
    agreed_.payload_bytes = arv_camera_get_payload(camera_, failure);
    if (failure.failed()) Fail("does not report the size of a frame: " + failure.text());
    agreed_.has_stamps = HasStamps();
    return std::move(agreed_);
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw SetupError(request_.device + ": " + what);
  }
  void Remark(std::string what) { agreed_.remarks.push_back(std::move(what)); }
  bool Has(const char* feature) const {
    return arv_camera_is_feature_available(camera_, feature, nullptr);
  }
  void SetSize();
  void SetFormat();
  void SetRate();
  void SetExposure();
  void SetGain();
  void SetPtp();
  void RequirePtp() const;
  bool HasStamps() const;
  std::string Formats() const;

  ArvCamera* const camera_;
  const CameraRequest& request_;
  const AravisSettings& settings_;
  AravisAgreement agreed_;
};

void Negotiation::SetSize() {
  GFailure failure;
  if (request_.width_px > 0) {
    int x = 0, y = 0, width = 0, height = 0;
    arv_camera_get_region(camera_, &x, &y, &width, &height, nullptr);
    // On cameras with a single size, writing fails even if the value is unchanged.
    if (width != request_.width_px || height != request_.height_px) {
      arv_camera_set_region(camera_, 0, 0, request_.width_px, request_.height_px, failure);
    }
  }
  int x = 0, y = 0;
  arv_camera_get_region(camera_, &x, &y, &agreed_.width_px, &agreed_.height_px, nullptr);
  if (request_.width_px > 0 &&
      (agreed_.width_px != request_.width_px || agreed_.height_px != request_.height_px)) {
    Fail("delivers pictures of " + std::to_string(agreed_.width_px) + " x " +
         std::to_string(agreed_.height_px) + "; expected " + std::to_string(request_.width_px) +
         " x " + std::to_string(request_.height_px));
  }
}

std::string Negotiation::Formats() const {
  guint count = 0;
  const char** names = arv_camera_dup_available_pixel_formats_as_strings(camera_, &count, nullptr);
  return JoinNames(names, count);
}

void Negotiation::SetFormat() {
  GFailure failure;
  if (!settings_.format.empty()) {
    arv_camera_set_pixel_format_from_string(camera_, settings_.format.c_str(), failure);
  } else {
    guint count = 0;
    const std::unique_ptr<gint64, GFree> codes(
        arv_camera_dup_available_pixel_formats(camera_, &count, nullptr));
    const std::span<const gint64> available(codes.get(), codes ? count : 0);
    const auto wanted =
        std::ranges::find_if(kAravisFormats, [&available](const AravisFormat& format) {
          return std::ranges::count(available, gint64{format.code}) > 0;
        });
    if (wanted == kAravisFormats.end()) Fail("has no supported format; it has " + Formats());
    arv_camera_set_pixel_format(camera_, wanted->code, failure);
  }
  if (failure.failed()) {
    Fail("format " + Quoted(settings_.format) + " cannot be set; it has " + Formats());
  }
  const auto format = FindAravisFormat(arv_camera_get_pixel_format(camera_, nullptr));
  if (!format) {
    Fail("format " + Quoted(settings_.format) +
         " is not supported; expected 8-bit Mono, Bayer, RGB, BGR or YUV422");
  }
  agreed_.format = *format;
}

void Negotiation::SetRate() {
  agreed_.fps = request_.fps;
  GFailure failure;
  // This also disables triggers.
  arv_camera_set_frame_rate(camera_, request_.fps, failure);
  if (!settings_.trigger.empty()) return;
  if (failure.failed()) Remark("its frame rate cannot be set: " + failure.text());
  const double got = arv_camera_get_frame_rate(camera_, nullptr);
  if (got <= 0) return;
  agreed_.fps = got;
  if (Differs(got, request_.fps)) {
    Remark("delivers " + Number(got) + " frames a second instead of " + Number(request_.fps) +
           ": try a shorter exposure_us, a smaller picture or a format with fewer bytes");
  }
}

void Negotiation::SetExposure() {
  if (!arv_camera_is_exposure_time_available(camera_, nullptr)) {
    if (settings_.exposure_us) Remark("has no exposure that can be set");
    return;
  }
  const bool has_automatic = arv_camera_is_exposure_auto_available(camera_, nullptr);
  if (settings_.exposure_us) {
    if (has_automatic) arv_camera_set_exposure_time_auto(camera_, ARV_AUTO_OFF, nullptr);
    arv_camera_set_exposure_time(camera_, *settings_.exposure_us, nullptr);
  } else if (has_automatic && arv_camera_get_exposure_time_auto(camera_, nullptr) != ARV_AUTO_OFF) {
    Remark("has automatic exposure, which changes the background: set exposure_us");
  }
  const double got_us = arv_camera_get_exposure_time(camera_, nullptr);
  agreed_.exposure_ns = std::llround(got_us * 1e3);
  if (settings_.exposure_us && Differs(got_us, *settings_.exposure_us)) {
    Remark("exposes for " + Number(got_us) + " us instead of " + Number(*settings_.exposure_us));
  }
  if (got_us * 1e-6 * agreed_.fps > 1) {
    Remark("exposes for " + Number(got_us) +
           " us, longer than a frame lasts: set exposure_us below " + Number(1e6 / agreed_.fps));
  }
}

void Negotiation::SetGain() {
  if (!settings_.gain) return;
  if (!arv_camera_is_gain_available(camera_, nullptr)) {
    Remark("has no gain that can be set");
    return;
  }
  if (arv_camera_is_gain_auto_available(camera_, nullptr)) {
    arv_camera_set_gain_auto(camera_, ARV_AUTO_OFF, nullptr);
  }
  arv_camera_set_gain(camera_, *settings_.gain, nullptr);
  const double got = arv_camera_get_gain(camera_, nullptr);
  if (Differs(got, *settings_.gain)) {
    Remark("its gain is " + Number(got) + " instead of " + Number(*settings_.gain));
  }
}

void Negotiation::SetPtp() {
  if (!settings_.ptp) return;
  // The standard's current names, and its former ones.
  constexpr std::pair<const char*, const char*> kNames[] = {{"PtpEnable", "PtpStatus"},
                                                            {"GevIEEE1588", "GevIEEE1588Status"}};
  for (const auto& [enable, status] : kNames) {
    if (!Has(enable)) continue;
    GFailure failure;
    arv_camera_set_boolean(camera_, enable, TRUE, failure);
    if (failure.failed()) Remark("PTP cannot be switched on: " + failure.text());
    if (Has(status)) agreed_.ptp_status = status;
    return;
  }
}

void Negotiation::RequirePtp() const {
  if (arv_camera_is_gv_device(camera_) && !agreed_.ptp_status.empty()) return;
  Fail("trigger \"ptp\" cannot be set; expected a GigE Vision camera that reports its PTP status");
}

bool Negotiation::HasStamps() const {
  ArvDevice* device = arv_camera_get_device(camera_);
  if (!ARV_IS_GV_DEVICE(device)) return true;
  GFailure failure;
  const auto frequency = arv_gv_device_get_timestamp_tick_frequency(ARV_GV_DEVICE(device), failure);
  return failure.failed() || frequency > 0;
}

}  // namespace

AravisAgreement Agree(ArvCamera* camera, const CameraRequest& request,
                      const AravisSettings& settings) {
  return Negotiation(camera, request, settings).Conclude();
}

}  // namespace mocap
