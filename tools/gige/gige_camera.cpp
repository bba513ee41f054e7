#include "tools/gige/gige_camera.h"

#include <arv.h>
#include <netinet/in.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <span>

#include "core/errors.h"
#include "drivers/clock.h"
#include "tools/gige/gige_description.h"
#include "tools/gige/gige_pixels.h"

namespace mocap {
namespace {

using std::chrono::milliseconds;

// Values read by Aravis's server, which polls for a trigger at this rate.
constexpr std::uint32_t kOn = 1, kSoftware = 1;
constexpr double kLooks_hz = 10'000;
constexpr std::uint32_t kMac = 0x0008, kUserName = 0x00e8;
constexpr std::size_t kUserNameBytes = 16;
constexpr std::uint32_t kPeriod_us = 33'333;
constexpr std::uint64_t kFrameNumbers = 65535;
constexpr std::int64_t kTai_ns = 37'000'000'000;
constexpr milliseconds kSourceTimeout{50};
constexpr std::chrono::seconds kSourcePatience{10};
constexpr std::uint32_t kTimestampControl = 0x0944, kTimestampHigh = 0x0948, kTimestampLow = 0x094c;
constexpr std::uint32_t kLatch = 2;
/// An action releases the first picture taken later than this long before it.
constexpr std::int64_t kMatch_ns = 1'000'000;
/// Longer than the server takes to notice that a client started it.
constexpr milliseconds kPatience{150};

/// Provides the description as a file, which Aravis requires.
class DescriptionFile {
 public:
  explicit DescriptionFile(const std::string& xml) : fd_(memfd_create("genicam", MFD_CLOEXEC)) {
    MOCAP_CHECK(fd_ >= 0 && write(fd_, xml.data(), xml.size()) == static_cast<ssize_t>(xml.size()));
  }
  ~DescriptionFile() { close(fd_); }
  DescriptionFile(const DescriptionFile&) = delete;
  DescriptionFile& operator=(const DescriptionFile&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }

 private:
  int fd_;
};

}  // namespace

GigeCamera::GigeCamera(const GigeIdentity& identity, std::unique_ptr<CameraDriver> source,
                       const GigeFaults& faults)
    : identity_(identity),
      faults_(faults),
      switched_on_ns_(TimelineNs()),
      source_(std::move(source)),
      random_(static_cast<std::minstd_rand::result_type>(faults.seed)) {
  StartSource();
  const DescriptionFile description(DescribeGigeCamera(identity.has_ptp));
  server_.reset(arv_gv_fake_camera_new_full(identity.ip.c_str(), identity.serial.c_str(),
                                            description.path().c_str()));
  if (!arv_gv_fake_camera_is_running(server_.get())) {
    throw SetupError(identity.ip +
                     ": cannot be served; expected an address of this host that no other camera "
                     "uses: as root, ip addr add " +
                     identity.ip + "/8 dev lo");
  }
  g_object_set(server_.get(), "gvsp-lost-ratio", faults.lost_packets, nullptr);
  registers_ = arv_gv_fake_camera_get_fake_camera(server_.get());
  arv_fake_camera_set_trigger_frequency(registers_, kLooks_hz);
  Write(ARV_FAKE_CAMERA_REGISTER_TRIGGER_MODE, kOn);
  Write(ARV_FAKE_CAMERA_REGISTER_TRIGGER_SOURCE, kSoftware);
  Write(gige_register::kFramePeriod_us, kPeriod_us);
  Write(gige_register::kPtpStatus, static_cast<std::uint32_t>(GigePtp::kDisabled));
  std::array<char, kUserNameBytes> name{};
  identity.name.copy(name.data(), name.size() - 1);
  arv_fake_camera_write_memory(registers_, kUserName, name.size(), name.data());
  const auto hash = std::hash<std::string>()(identity.serial);
  const std::array<std::uint8_t, 8> mac{0,
                                        0,
                                        2,
                                        0,
                                        static_cast<std::uint8_t>(hash >> 24),
                                        static_cast<std::uint8_t>(hash >> 16),
                                        static_cast<std::uint8_t>(hash >> 8),
                                        static_cast<std::uint8_t>(hash)};
  arv_fake_camera_write_memory(registers_, kMac, mac.size(), mac.data());
  arv_fake_camera_set_fill_pattern(registers_, Fill, this);
  server_thread_ = std::make_unique<GigeServerThread>(
      identity.ip, GigeServerThread::Extras{[this] { LatchTime(); },
                                            [this](auto packet) { return TakeAction(packet); }});
  thread_ = std::thread([this] { RunSource(); });
}

GigeCamera::~GigeCamera() {
  stopping_.store(true);
  thread_.join();
  server_.reset();
}

std::uint32_t GigeCamera::Read(std::uint32_t address) const {
  std::uint32_t value = 0;
  arv_fake_camera_read_register(registers_, address, &value);
  return value;
}

void GigeCamera::Write(std::uint32_t address, std::uint32_t value) {
  arv_fake_camera_write_register(registers_, address, value);
}

bool GigeCamera::is_streaming() const {
  return arv_fake_camera_get_acquisition_status(registers_) != 0;
}

// When a take is joined late, starting may include catching up. Cameras that answer must stream as
// soon as they are started.
void GigeCamera::StartSource() {
  source_->Start();
  Frame first;
  const auto patience = std::chrono::steady_clock::now() + kSourcePatience;
  while (source_->Grab(first, kSourceTimeout) == GrabStatus::kTimeout &&
         std::chrono::steady_clock::now() < patience) {
  }
}

void GigeCamera::RunSource() {
  std::uniform_real_distribution<double> jitter_ms(0, faults_.jitter_ms);
  while (!stopping_.load()) {
    FollowPtp();
    Frame frame;
    const GrabStatus status = source_->Grab(frame, kSourceTimeout);
    if (status == GrabStatus::kEnd) std::this_thread::sleep_for(kSourceTimeout);
    if (status != GrabStatus::kFrame || !IsWanted(frame.capture_ns)) continue;
    const std::int64_t exposure_ns = Read(ARV_FAKE_CAMERA_REGISTER_EXPOSURE_TIME_US) * 1000LL;
    const auto late_ns = static_cast<std::int64_t>(jitter_ms(random_) * 1e6);
    SleepUntil(frame.capture_ns + exposure_ns / 2 + late_ns);
    if (!is_streaming()) {
      const std::lock_guard lock(mutex_);
      is_flowing_ = is_waiting_ = false;
    } else if (!stalled_.load(std::memory_order_relaxed)) {
      Send(frame);
    }
  }
  source_->Stop();
}

bool GigeCamera::IsWanted(std::int64_t capture_ns) {
  const bool is_triggered = Read(gige_register::kTriggerMode) == kOn;
  const std::uint32_t source = Read(gige_register::kTriggerSource);
  if (is_triggered && source == static_cast<std::uint32_t>(GigeTrigger::kAction1)) {
    return HasAction(DeviceTime(capture_ns));
  }
  if (is_triggered && source == static_cast<std::uint32_t>(GigeTrigger::kSoftware)) {
    const bool fired = Read(gige_register::kTriggerSoftware) != 0;
    Write(gige_register::kTriggerSoftware, 0);
    return fired;
  }
  const std::int64_t period_ns = is_triggered ? 0 : Read(gige_register::kFramePeriod_us) * 1000LL;
  // Frames jitter about their times, and rates differ slightly from their nominal values.
  if (capture_ns < next_wanted_ns_ - period_ns / 4) return false;
  next_wanted_ns_ = std::max(next_wanted_ns_ + period_ns, capture_ns + period_ns * 9 / 10);
  return true;
}

void GigeCamera::Send(const Frame& frame) {
  {
    std::unique_lock lock(mutex_);
    // Frames in a burst wait for each other, so that the first is sent without delay.
    taken_.wait_for(lock, kPatience, [this] { return !is_waiting_ || !is_flowing_; });
    is_waiting_ = true;
    if (picture_.width() != frame.image.width() || picture_.height() != frame.image.height()) {
      picture_ = Image<Bgr>(frame.image.width(), frame.image.height());
    }
    for (int y = 0; y < frame.image.height(); ++y) {
      std::copy_n(frame.image.row(y), frame.image.width(), picture_.row(y));
    }
    capture_ns_ = frame.capture_ns;
    ++sequence_;
  }
  Write(ARV_FAKE_CAMERA_REGISTER_TRIGGER_SOFTWARE, 1);
  server_thread_->Wake();
}

void GigeCamera::LatchTime() {
  if ((Read(kTimestampControl) & kLatch) == 0) return;
  const auto time_ns = static_cast<std::uint64_t>(DeviceTime(TimelineNs()));
  Write(kTimestampHigh, static_cast<std::uint32_t>(time_ns >> 32));
  Write(kTimestampLow, static_cast<std::uint32_t>(time_ns));
  Write(kTimestampControl, 0);
}

std::optional<std::uint16_t> GigeCamera::TakeAction(std::span<const std::byte> packet) {
  const auto number = [packet](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, packet.data() + at, sizeof(value));
    return ntohl(value);
  };
  // Actions with a time.
  constexpr std::uint32_t kAction = 0x0100, kHasTime = 0x80 << 16;
  constexpr std::size_t kBytes = 28;
  if (packet.size() != kBytes || (number(0) & 0xffff) != kAction || (number(0) & kHasTime) == 0) {
    return std::nullopt;
  }
  constexpr std::uint16_t kDone = 0, kRefused = 0x8006, kLate = 0x8016;
  if (number(8) != Read(gige_register::kActionDeviceKey) ||
      number(12) != Read(gige_register::kActionGroupKey) ||
      (number(16) & Read(gige_register::kActionGroupMask)) == 0) {
    return kRefused;
  }
  const auto time_ns = static_cast<std::int64_t>(std::uint64_t{number(20)} << 32 | number(24));
  const std::lock_guard lock(mutex_);
  actions_ns_.push_back(time_ns);
  return time_ns < DeviceTime(TimelineNs()) ? kLate : kDone;
}

bool GigeCamera::HasAction(std::int64_t time_ns) {
  const std::lock_guard lock(mutex_);
  const auto is_due = [time_ns](std::int64_t action_ns) {
    return action_ns <= time_ns + kMatch_ns;
  };
  return std::erase_if(actions_ns_, is_due) > 0;
}

void GigeCamera::FollowPtp() {
  if (!identity_.has_ptp) return;
  const bool enabled = Read(gige_register::kPtpEnable) != 0;
  const GigePtp once_enabled = faults_.has_no_ptp_master ? GigePtp::kListening : GigePtp::kSlave;
  Write(gige_register::kPtpStatus,
        static_cast<std::uint32_t>(enabled ? once_enabled : GigePtp::kDisabled));
}

std::int64_t GigeCamera::DeviceTime(std::int64_t host_ns) const {
  if (Read(gige_register::kPtpStatus) == static_cast<std::uint32_t>(GigePtp::kSlave)) {
    return host_ns + kTai_ns;
  }
  const auto running_ns = static_cast<double>(host_ns - switched_on_ns_);
  return host_ns + faults_.clock_offset_ns +
         std::llround(running_ns * faults_.clock_drift_ppm * 1e-6);
}

void GigeCamera::Fill(ArvBuffer* buffer, void* camera, unsigned exposure_us, unsigned,
                      unsigned pixel_format) {
  static_cast<GigeCamera*>(camera)->FillBuffer(buffer, exposure_us * 1000LL, pixel_format);
}

void GigeCamera::FillBuffer(ArvBuffer* buffer, std::int64_t exposure_ns, unsigned pixel_format) {
  std::size_t size = 0;
  auto* data = static_cast<std::uint8_t*>(const_cast<void*>(arv_buffer_get_data(buffer, &size)));
  const int width = arv_buffer_get_image_width(buffer),
            height = arv_buffer_get_image_height(buffer);
  // Aravis passes no size here; it has allocated what the format needs.
  size =
      static_cast<std::size_t>(width) * height * ARV_PIXEL_FORMAT_BIT_PER_PIXEL(pixel_format) / 8;
  const std::lock_guard lock(mutex_);
  if (picture_.width() != width || picture_.height() != height) {
    Image<Bgr> cut(width, height);
    for (int y = 0; y < std::min(height, picture_.height()); ++y) {
      std::copy_n(picture_.row(y), std::min(width, picture_.width()), cut.row(y));
    }
    picture_ = std::move(cut);
  }
  EncodePicture(picture_.view(), pixel_format, std::span(data, size));
  arv_buffer_set_timestamp(buffer, DeviceTime(capture_ns_ - exposure_ns / 2));
  arv_buffer_set_frame_id(buffer, 1 + (sequence_ - 1) % kFrameNumbers);
  is_waiting_ = false;
  is_flowing_ = true;
  taken_.notify_one();
}

}  // namespace mocap
