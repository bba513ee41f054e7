#include "drivers/aravis/aravis_session.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>
#include <thread>

#include "core/errors.h"
#include "drivers/aravis/gige_probe.h"
#include "drivers/clock.h"

namespace mocap {
namespace {

constexpr std::size_t kBuffers = 10;
constexpr std::size_t kAlignment = 4096;
constexpr int kRealtimePriority = 10;
/// Frames that the kernel should buffer while this program does not run.
constexpr double kFramesInSocket = 2;
constexpr std::size_t kLeastSocketBytes = 1 << 20;
/// How long missing packets may delay the frames behind them.
constexpr double kRetentionPeriods = 0.8;
constexpr unsigned kShortestRetention_us = 10'000, kLongestRetention_us = 40'000;
constexpr unsigned kPacketTimeout_us = 10'000;
/// A camera whose program died stays held for its heartbeat timeout, 3 s in practice.
constexpr std::chrono::milliseconds kHeartbeat{3500};
constexpr std::chrono::milliseconds kProbePatience{300};
constexpr int kProbes = 3;

/// The largest receive buffer of a socket; 0: unknown. Asks a socket, as a service may not read
/// /proc/sys.
std::size_t LargestSocketBuffer() {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return 0;
  constexpr int kMore = 1 << 30;
  int bytes = 0;
  socklen_t size = sizeof bytes;
  const bool is_known = setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &kMore, sizeof kMore) == 0 &&
                        getsockopt(fd, SOL_SOCKET, SO_RCVBUF, &bytes, &size) == 0;
  close(fd);
  // The kernel doubles the requested value for its own overhead.
  return is_known && bytes > 0 ? static_cast<std::size_t>(bytes) / 2 : 0;
}

bool MayOpenPacketSocket() {
  const int fd = socket(AF_PACKET, SOCK_RAW | SOCK_CLOEXEC, 0);
  if (fd >= 0) close(fd);
  return fd >= 0;
}

GigePresence ProbeThoroughly(const std::string& ip) {
  for (int i = 0; i < kProbes; ++i) {
    const GigePresence presence = ProbeGigeCamera(ip, kProbePatience);
    if (presence != GigePresence::kAbsent) return presence;
  }
  return GigePresence::kAbsent;
}

/// Aravis takes seconds to fail and hides the reason.
void RequireFree(const AravisTarget& target) {
  GigePresence presence = ProbeThoroughly(target.ip);
  if (presence == GigePresence::kHeld) {
    std::this_thread::sleep_for(kHeartbeat);
    presence = ProbeThoroughly(target.ip);
  }
  if (presence == GigePresence::kHeld) {
    throw SetupError(target.device + ": is controlled by another program, which has to stop first");
  }
  if (presence == GigePresence::kAbsent) {
    throw SetupError(target.device + ": no GigE Vision camera answers at " + target.ip +
                     "; check its power, its cable and its address");
  }
}

}  // namespace

AravisSession::AravisSession(const AravisTarget& target, const CameraRequest& request,
                             const AravisSettings& settings)
    : AravisSession(Closed{}, target, request, settings) {
  OpenCamera();
  agreed_ = Agree(camera_.get(), request_, settings_);
  if (!target_.serial.empty() && !agreed_.serial.empty() && target_.serial != agreed_.serial) {
    throw SetupError(target_.device + ": the camera at " + target_.ip + " has the serial number " +
                     agreed_.serial + "; expected " + target_.serial);
  }
  target_.serial = agreed_.serial;
  OpenStream();
  FillPool();
  GFailure failure;
  arv_camera_start_acquisition(camera_.get(), failure);
  if (failure.failed()) throw SetupError(target_.device + ": does not start: " + failure.text());
}

AravisSession::~AravisSession() {
  if (!camera_) return;
  g_signal_handlers_disconnect_by_data(arv_camera_get_device(camera_.get()), this);
  if (stream_) arv_camera_stop_acquisition(camera_.get(), nullptr);
}

void AravisSession::OpenCamera() {
  GFailure failure;
  if (!target_.ip.empty()) RequireFree(target_);
  const auto route = RouteTo(target_.ip);
  const std::lock_guard lock(AravisMutex());
  if (target_.ip.empty()) {
    camera_.reset(arv_camera_new(target_.id.c_str(), failure));
  } else {
    if (!route) throw SetupError(target_.device + ": there is no network route to " + target_.ip);
    const GPtr<GInetAddress> local(g_inet_address_new_from_string(route->local_ip.c_str()));
    const GPtr<GInetAddress> remote(g_inet_address_new_from_string(target_.ip.c_str()));
    const GPtr<ArvDevice> device(arv_gv_device_new(local.get(), remote.get(), failure));
    if (device) camera_.reset(arv_camera_new_with_device(device.get(), failure));
  }
  if (!camera_) throw SetupError(target_.device + ": cannot be opened: " + failure.text());
  ArvDevice* device = arv_camera_get_device(camera_.get());
  if (ARV_IS_GV_DEVICE(device) && !arv_gv_device_is_controller(ARV_GV_DEVICE(device))) {
    throw SetupError(target_.device + ": another program took control of it");
  }
  g_signal_connect(device, "control-lost", G_CALLBACK(OnControlLost), this);
}

void AravisSession::ChoosePacketPath() {
  const std::size_t wanted = std::max(
      kLeastSocketBytes, static_cast<std::size_t>(kFramesInSocket * agreed_.payload_bytes));
  const std::size_t allowed = LargestSocketBuffer();
  const bool is_small = allowed > 0 && allowed < wanted;
  const bool may = MayOpenPacketSocket();
  const bool use = may && settings_.packet_socket.value_or(is_small);
  if (settings_.packet_socket.value_or(false) && !may) {
    stream_remarks_.push_back(
        "packet_socket is refused, UDP sockets are used: give the program CAP_NET_RAW");
  }
  if (!use && is_small) {
    stream_remarks_.push_back(
        "net.core.rmem_max is " + std::to_string(allowed) + ", less than two frames, so that " +
        "packets will be lost: as root, sysctl -w net.core.rmem_max=" + std::to_string(2 * wanted));
  }
  arv_camera_gv_set_stream_options(
      camera_.get(), use ? ARV_GV_STREAM_OPTION_NONE : ARV_GV_STREAM_OPTION_PACKET_SOCKET_DISABLED);
}

void AravisSession::OpenStream() {
  const bool is_gige = arv_camera_is_gv_device(camera_.get());
  GFailure failure;
  if (is_gige) {
    ChoosePacketPath();
    if (settings_.packet_bytes) {
      arv_camera_gv_set_packet_size_adjustment(camera_.get(), ARV_GV_PACKET_SIZE_ADJUSTMENT_NEVER);
      arv_camera_gv_set_packet_size(camera_.get(), *settings_.packet_bytes, failure);
      if (failure.failed()) {
        throw SetupError(target_.device + ": packet_bytes cannot be set: " + failure.text());
      }
    } else {
      arv_camera_gv_set_packet_size_adjustment(camera_.get(), ARV_GV_PACKET_SIZE_ADJUSTMENT_ALWAYS);
    }
    if (settings_.packet_delay_us) {
      arv_camera_gv_set_packet_delay(camera_.get(), std::llround(*settings_.packet_delay_us * 1e3),
                                     failure);
      if (failure.failed()) {
        stream_remarks_.push_back("packet_delay_us cannot be set: " + failure.text());
      }
    }
  }
  stream_.reset(arv_camera_create_stream(camera_.get(), OnStream, this, failure));
  if (!stream_) throw SetupError(target_.device + ": cannot stream: " + failure.text());
  if (!is_gige) return;
  const double retention_us = kRetentionPeriods * 1e6 / std::max(agreed_.fps, 1.0);
  g_object_set(
      stream_.get(), "socket-buffer", ARV_GV_STREAM_SOCKET_BUFFER_FIXED, "socket-buffer-size",
      static_cast<int>(std::min<std::size_t>(LargestSocketBuffer(), 64 << 20)), "packet-resend",
      ARV_GV_STREAM_PACKET_RESEND_ALWAYS, "packet-timeout", kPacketTimeout_us, "frame-retention",
      static_cast<unsigned>(
          std::clamp<double>(retention_us, kShortestRetention_us, kLongestRetention_us)),
      nullptr);
}

void AravisSession::FillPool() {
  // Aravis would fill buffers one byte short as far as possible, and report success.
  const std::size_t slot = (agreed_.payload_bytes + kAlignment - 1) / kAlignment * kAlignment;
  pool_.resize(slot * kBuffers + kAlignment);
  void* begin = pool_.data();
  std::size_t space = pool_.size();
  auto* first = static_cast<std::uint8_t*>(std::align(kAlignment, slot * kBuffers, begin, space));
  for (std::size_t i = 0; i < kBuffers; ++i) {
    Push(arv_buffer_new_full(slot, first + i * slot, nullptr, nullptr));
  }
}

ArvBuffer* AravisSession::Pop(std::chrono::microseconds timeout) {
  return arv_stream_timeout_pop_buffer(stream_.get(), static_cast<guint64>(timeout.count()));
}

bool AravisSession::Trigger() {
  GFailure failure;
  arv_camera_software_trigger(camera_.get(), failure);
  return !failure.failed();
}

std::string AravisSession::PtpStatus() {
  if (agreed_.ptp_status.empty()) return "";
  // Some cameras update this state only when told to latch it.
  if (arv_camera_is_feature_available(camera_.get(), "PtpDataSetLatch", nullptr)) {
    arv_camera_execute_command(camera_.get(), "PtpDataSetLatch", nullptr);
  }
  const char* status = arv_camera_get_string(camera_.get(), agreed_.ptp_status.c_str(), nullptr);
  return status ? status : "";
}

std::optional<std::int64_t> AravisSession::ClockAheadNs() {
  // Registers that all GigE Vision cameras have.
  constexpr guint64 kControl = 0x0944, kLatchedHigh = 0x0948, kLatchedLow = 0x094c;
  constexpr guint32 kLatch = 2;
  ArvDevice* device = arv_camera_get_device(camera_.get());
  GFailure failure;
  const std::int64_t before_ns = TimelineNs();
  if (!arv_device_write_register(device, kControl, kLatch, failure)) return std::nullopt;
  const std::int64_t host_ns = before_ns + (TimelineNs() - before_ns) / 2;
  guint32 high = 0, low = 0;
  if (!arv_device_read_register(device, kLatchedHigh, &high, failure)) return std::nullopt;
  if (!arv_device_read_register(device, kLatchedLow, &low, failure)) return std::nullopt;
  return static_cast<std::int64_t>(std::uint64_t{high} << 32 | low) - host_ns;
}

std::vector<std::string> AravisSession::StreamRemarks() const {
  std::vector<std::string> remarks = stream_remarks_;
  if (realtime_.load(std::memory_order_relaxed) == Realtime::kRefused) {
    remarks.push_back(
        "its thread has no real-time priority, so that a busy machine loses packets: give the "
        "program CAP_SYS_NICE or the user an rtprio limit");
  }
  return remarks;
}

AravisCounters AravisSession::Counters() const {
  const auto read = [this](const char* name) {
    return arv_stream_get_info_uint64_by_name(stream_.get(), name);
  };
  guint64 completed = 0, failures = 0, underruns = 0;
  arv_stream_get_statistics(stream_.get(), &completed, &failures, &underruns);
  if (!arv_camera_is_gv_device(camera_.get())) return {0, 0, underruns};
  return {read("n_missing_packets"), read("n_resend_requests"), underruns};
}

std::uint64_t AravisSession::SignsOfLife() const {
  guint64 completed = 0, failures = 0, underruns = 0;
  arv_stream_get_statistics(stream_.get(), &completed, &failures, &underruns);
  // Buffers fail after some time even if nothing arrives.
  if (!arv_camera_is_gv_device(camera_.get())) return completed + underruns;
  return arv_stream_get_info_uint64_by_name(stream_.get(), "n_received_packets");
}

void AravisSession::OnStream(void* session, ArvStreamCallbackType type, ArvBuffer*) {
  if (type != ARV_STREAM_CALLBACK_TYPE_INIT) return;
  const bool granted = arv_make_thread_realtime(kRealtimePriority);
  static_cast<AravisSession*>(session)->realtime_.store(
      granted ? Realtime::kGranted : Realtime::kRefused, std::memory_order_relaxed);
}

void AravisSession::OnControlLost(ArvDevice*, void* session) {
  static_cast<AravisSession*>(session)->control_lost_.store(true, std::memory_order_relaxed);
}

}  // namespace mocap
