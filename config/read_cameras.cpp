#include "config/read_cameras.h"

#include <array>
#include <cmath>
#include <numbers>

#include "drivers/take/take_layout.h"

namespace mocap {
namespace {

constexpr double kLargestSide_px = 16384;
constexpr double kLongestExposure_us = 1e6;
constexpr double kFullTurn_rad = 2 * std::numbers::pi;
constexpr double kMostGain = 1e6;
constexpr double kMostFocus = 1e6;
// Packet size including headers.
constexpr int kLeastPacket = 576, kLargestPacket = 16000;
constexpr double kLongestDelay_us = 1e4;

std::optional<double> OptionalWithin(TomlSection& section, const std::string& key, double min,
                                     double max) {
  if (!section.Has(key)) return std::nullopt;
  return section.NumberWithin(key, min, max);
}

V4l2Settings ReadV4l2Settings(TomlSection& section, const std::string& driver) {
  V4l2Settings settings;
  settings.format = section.Text("format", "");
  if (settings.format.size() > 4 && driver == "v4l2") {
    section.Fail("format", "is not a four-letter format code such as \"YUYV\" or \"MJPG\"");
  }
  settings.exposure_us = OptionalWithin(section, "exposure_us", 1, kLongestExposure_us);
  settings.white_balance_k = OptionalWithin(section, "white_balance_k", 1000, 20000);
  settings.gain = OptionalWithin(section, "gain", 0, kMostGain);
  settings.focus = OptionalWithin(section, "focus", 0, kMostFocus);
  if (section.Has("power_line_hz")) {
    const auto hz = static_cast<int>(section.IntegerWithin("power_line_hz", 0, 60));
    if (hz != 0 && hz != 50 && hz != 60) {
      section.Fail("power_line_hz", "is " + std::to_string(hz) + "; expected 0, 50 or 60");
    }
    settings.power_line_hz = hz;
  }
  return settings;
}

AravisSettings ReadAravisSettings(TomlSection& section) {
  AravisSettings settings;
  settings.format = section.Text("format", "");
  settings.exposure_us = OptionalWithin(section, "exposure_us", 1, kLongestExposure_us);
  settings.gain = OptionalWithin(section, "gain", 0, kMostGain);
  settings.trigger = section.Text("trigger", "");
  settings.strobe = section.Text("strobe", "");
  if (!settings.strobe.empty() && settings.strobe == settings.trigger) {
    section.Fail("strobe", "is also the line of trigger; expected another line");
  }
  settings.ptp = section.Flag("ptp", settings.ptp);
  if (settings.is_scheduled() && !settings.ptp) {
    section.Fail("ptp", "is false, but trigger is \"ptp\"; expected true");
  }
  if (section.Has("packet_bytes")) {
    settings.packet_bytes =
        static_cast<int>(section.IntegerWithin("packet_bytes", kLeastPacket, kLargestPacket));
  }
  settings.packet_delay_us = OptionalWithin(section, "packet_delay_us", 0, kLongestDelay_us);
  if (section.Has("packet_socket")) settings.packet_socket = section.Flag("packet_socket", false);
  return settings;
}

std::optional<std::array<double, 2>> ReadRange(TomlSection& section, const std::string& key) {
  if (!section.Has(key)) return std::nullopt;
  const std::vector<double> range = section.Numbers(key, 2);
  if (!(range[0] < range[1] && range[0] >= -kFullTurn_rad && range[1] <= kFullTurn_rad)) {
    section.Fail(key, "is not a range; expected [least, most] in radians");
  }
  return std::array<double, 2>{range[0], range[1]};
}

/// Keys that only some heads have, for messages about keys that are wrong.
void ReserveHeadKeys(TomlSection& section) {
  section.Reserve({"head_device"}, "needs head = \"uvc\"");
  section.Reserve({"pan_rad", "tilt_rad"}, "needs head = \"fixed\"");
  section.Reserve({"head_delay_ms", "follow", "pan_range_rad", "tilt_range_rad"},
                  "needs head = \"v4l2\" or \"uvc\"");
}

HeadConfig ReadHead(TomlSection& section) {
  HeadConfig head;
  ReserveHeadKeys(section);
  if (!section.Has("head")) return head;
  constexpr std::array kKinds = {HeadKind::kFixed, HeadKind::kV4l2, HeadKind::kUvc};
  head.kind = kKinds[section.Choice("head", {"fixed", "v4l2", "uvc"})];
  if (head.kind == HeadKind::kFixed) {
    head.angles.pan_rad = section.NumberWithin("pan_rad", -kFullTurn_rad, kFullTurn_rad, 0);
    head.angles.tilt_rad = section.NumberWithin("tilt_rad", -kFullTurn_rad, kFullTurn_rad, 0);
    return head;
  }
  if (head.kind == HeadKind::kUvc) head.device = section.Text("head_device");
  head.delay_ms = section.NumberWithin("head_delay_ms", 0, 1000, 0);
  head.follow = section.Flag("follow", false);
  head.pan_range_rad = ReadRange(section, "pan_range_rad");
  head.tilt_range_rad = ReadRange(section, "tilt_range_rad");
  return head;
}

std::array<int, 2> ReadSize(TomlSection& section) {
  std::array<int, 2> size{};
  const std::vector<double> numbers = section.Numbers("size_px", 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const double side = numbers[i];
    if (!(side >= 2 && side <= kLargestSide_px && side == std::floor(side))) {
      section.Fail("size_px", "is not the size of a picture; expected [width, height] in pixels");
    }
    size[i] = static_cast<int>(side);
  }
  return size;
}

CameraConfig ReadCamera(TomlSection& section, const std::string& driver,
                        const std::vector<CameraConfig>& others) {
  CameraConfig camera;
  camera.name = section.Text("name");
  camera.device = section.Text("device");
  if (!IsCameraName(camera.name)) {
    section.Fail("name", "is not a valid camera name; expected letters, digits, _ and -");
  }
  for (const CameraConfig& other : others) {
    if (other.name == camera.name) section.Fail("name", "is also the name of another camera");
    if (other.device == camera.device)
      section.Fail("device", "is also the device of another camera");
  }
  if (camera.device.empty()) section.Fail("device", "is empty; expected a device");
  camera.fps = OptionalWithin(section, "fps", 1, 1000);
  if (section.Has("size_px")) camera.size_px = ReadSize(section);
  camera.head = ReadHead(section);
  if (driver != "aravis") camera.v4l2 = ReadV4l2Settings(section, driver);
  if (driver != "v4l2") camera.aravis = ReadAravisSettings(section);
  section.Reserve({"white_balance_k", "focus", "power_line_hz"}, "needs source.driver = \"v4l2\"");
  section.Reserve({"trigger", "strobe", "ptp", "packet_bytes", "packet_delay_us", "packet_socket"},
                  "needs source.driver = \"aravis\"");
  section.RejectUnknownKeys();
  return camera;
}

}  // namespace

std::vector<CameraConfig> ReadCameras(TomlSection& root, const std::string& driver) {
  std::vector<CameraConfig> cameras;
  for (TomlSection& section : root.Sections("cameras")) {
    cameras.push_back(ReadCamera(section, driver, cameras));
  }
  return cameras;
}

}  // namespace mocap
