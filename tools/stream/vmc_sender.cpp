#include "tools/stream/vmc_sender.h"

#include <lo/lo.h>

#include <charconv>
#include <cstdlib>
#include <memory>
#include <string_view>

#include "core/errors.h"

namespace mocap {
namespace {

constexpr double kMPerMm = 0.001;
/// 1500 bytes of Ethernet without the headers of IPv6 and UDP.
constexpr std::size_t kMostBytes = 1500 - 40 - 8;
/// Length before each message of a bundle.
constexpr std::size_t kLengthBytes = 4;

struct Place {
  std::string host, port;
};

/// Parses "HOST:PORT" or "[IPV6]:PORT".
Place ParsePlace(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const std::string_view port = std::string_view(text).substr(std::min(colon, text.size() - 1) + 1);
  std::string host = text.substr(0, std::min(colon, text.size()));
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  std::uint16_t number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  const bool is_port = error == std::errc() && end == port.data() + port.size() && number > 0;
  const bool has_more_colons = host.find(':') != std::string::npos && !text.starts_with('[');
  if (colon == std::string::npos || host.empty() || !is_port || has_more_colons) {
    throw SetupError(
        "--to: \"" + text +
        "\" is not an address; expected HOST:PORT, like 127.0.0.1:39539 or [::1]:39539");
  }
  return {host, std::to_string(number)};
}

UdpSender OpenPlace(const std::string& text) {
  const Place place = ParsePlace(text);
  try {
    return {place.host, place.port};
  } catch (const SetupError& error) {
    throw SetupError("--to: " + text + ": " + error.what());
  }
}

struct Status {
  int loaded, calibration, tracking;
};

/// The protocol has a model that is loaded or not, and calibration: 0 not begun, 2 in progress, 3
/// done.
Status StatusOf(CaptureState state) {
  switch (state) {
    case CaptureState::kSearching:
      return {0, 0, 0};
    case CaptureState::kAcquiring:
      return {0, 2, 0};
    case CaptureState::kTracking:
      return {1, 3, 1};
    case CaptureState::kLost:
    case CaptureState::kBridged:
      return {1, 3, 0};
  }
  return {0, 0, 0};
}

lo_message TransformMessage(std::string_view name, const RigidTransform& X) {
  const Matrix3 M = UnityFromStudio();
  const Eigen::Vector3f p = (M * X.p * kMPerMm).cast<float>();
  const Eigen::Quaternionf q(Matrix3(M * X.R * M.transpose()).cast<float>());
  lo_message message = lo_message_new();
  lo_message_add_string(message, std::string(name).c_str());
  for (const float number : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}) {
    lo_message_add_float(message, number);
  }
  return message;
}

}  // namespace

Matrix3 UnityFromStudio() {
  Matrix3 M;
  M << 0, -1, 0, 0, 0, 1, 1, 0, 0;
  return M;
}

VmcSender::VmcSender(const std::string& place)
    : receiver_(OpenPlace(place)), bundle_(nullptr, &lo_bundle_free_recursive) {
  SendState(CaptureState::kSearching, 0);
  if (!trouble_.empty()) throw SetupError("--to: " + place + ": " + trouble_);
}

void VmcSender::SendState(CaptureState state, double time_s) {
  Begin(state, time_s);
  Flush();
}

void VmcSender::SendPose(const HumanoidPose& pose, double time_s) {
  Begin(CaptureState::kTracking, time_s);
  Add("/VMC/Ext/Root/Pos", TransformMessage("root", {}));
  for (std::size_t i = 0; i < pose.size(); ++i) {
    Add("/VMC/Ext/Bone/Pos", TransformMessage(kHumanoid[i].name, pose[i]));
  }
  Flush();
}

void VmcSender::Begin(CaptureState state, double time_s) {
  trouble_.clear();
  bundle_.reset(lo_bundle_new(LO_TT_IMMEDIATE));
  const Status status = StatusOf(state);
  constexpr int kNormalMode = 0;
  lo_message available = lo_message_new();
  for (const int number : {status.loaded, status.calibration, kNormalMode, status.tracking}) {
    lo_message_add_int32(available, number);
  }
  Add("/VMC/Ext/OK", available);
  lo_message time = lo_message_new();
  lo_message_add_float(time, static_cast<float>(time_s));
  Add("/VMC/Ext/T", time);
}

void VmcSender::Add(const char* path, void* message) {
  const std::size_t bytes = kLengthBytes + lo_message_length(message, path);
  if (lo_bundle_length(bundle_.get()) + bytes > kMostBytes) {
    Flush();
    bundle_.reset(lo_bundle_new(LO_TT_IMMEDIATE));
  }
  lo_bundle_add_message(bundle_.get(), path, message);
}

void VmcSender::Flush() {
  std::size_t size = 0;
  const std::unique_ptr<void, void (*)(void*)> bytes(
      lo_bundle_serialise(bundle_.get(), nullptr, &size), &std::free);
  const std::string why = receiver_.Send({static_cast<const char*>(bytes.get()), size});
  if (!why.empty()) trouble_ = why;
}

}  // namespace mocap
