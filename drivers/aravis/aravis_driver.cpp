#include "drivers/aravis/aravis_driver.h"

#include <arv.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "core/errors.h"
#include "drivers/aravis/aravis_keeper.h"
#include "drivers/aravis/aravis_session.h"
#include "drivers/aravis/gige_probe.h"
#include "drivers/clock.h"
#include "drivers/usb/usb_bus.h"

namespace mocap {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// Time until a change of session is noticed.
constexpr milliseconds kSlice{20};
/// Time to close a camera that answers, and one that does not.
constexpr milliseconds kClosing{500}, kClosingTheDead{10'000};

std::chrono::microseconds Rest(steady_clock::time_point deadline) {
  const auto rest =
      std::chrono::duration_cast<std::chrono::microseconds>(deadline - steady_clock::now());
  return std::clamp<std::chrono::microseconds>(rest, std::chrono::microseconds(0), kSlice);
}

}  // namespace

AravisDriver::AravisDriver(const CameraRequest& request, const AravisSettings& settings)
    : request_(request), settings_(settings) {}

AravisDriver::~AravisDriver() { Stop(); }

void AravisDriver::Start() {
  MOCAP_CHECK(!keeper_);
  if (previous_) previous_->WaitClosed(kClosingTheDead);
  previous_.reset();
  auto session =
      std::make_shared<AravisSession>(FindAravisCamera(request_.device), request_, settings_);
  keeper_ = std::make_shared<AravisKeeper>(request_, settings_, std::move(session));
  keeper_->Start();
  FollowKeeper();
}

void AravisDriver::Stop() {
  if (!keeper_) return;
  GiveBack();
  session_.reset();
  clock_.reset();
  generation_ = 0;
  keeper_->RequestStop();
  keeper_->WaitClosed(kClosing);
  previous_ = std::exchange(keeper_, nullptr);
}

void AravisDriver::FollowKeeper() {
  const unsigned generation = keeper_->generation();
  if (generation == generation_) return;
  generation_ = generation;
  session_ = keeper_->session();
  if (!session_) return;
  fresh_ = true;
  if (!clock_) clock_.emplace(session_->agreed().has_stamps, LeapSeconds());
  clock_->Doubt();
  counter_.Forget();
}

void AravisDriver::GiveBack() {
  if (lent_) session_->Push(std::exchange(lent_, nullptr));
}

GrabStatus AravisDriver::Grab(Frame& frame, milliseconds timeout) {
  MOCAP_CHECK(keeper_);
  const steady_clock::time_point deadline = steady_clock::now() + timeout;
  const bool was_lost = keeper_->lost();
  GiveBack();
  do {
    FollowKeeper();
    if (!session_) {
      std::this_thread::sleep_for(Rest(deadline));
    } else if (ArvBuffer* buffer = session_->Pop(Rest(deadline))) {
      if (const auto status = Take(buffer, frame)) return *status;
    }
    // Report a loss at once to the caller that waits for this camera.
    if (keeper_->lost() && !was_lost) return GrabStatus::kLost;
  } while (steady_clock::now() < deadline);
  return keeper_->lost() ? GrabStatus::kLost : GrabStatus::kTimeout;
}

bool AravisDriver::IsWhole(ArvBuffer* buffer) const {
  const AravisAgreement& agreed = session_->agreed();
  std::size_t bytes = 0;
  arv_buffer_get_data(buffer, &bytes);
  // Aravis reports success even for partly filled buffers.
  return arv_buffer_get_status(buffer) == ARV_BUFFER_STATUS_SUCCESS &&
         arv_buffer_get_payload_type(buffer) == ARV_BUFFER_PAYLOAD_TYPE_IMAGE &&
         bytes >= agreed.payload_bytes &&
         arv_buffer_get_image_pixel_format(buffer) == agreed.format.code &&
         arv_buffer_get_image_width(buffer) == agreed.width_px &&
         arv_buffer_get_image_height(buffer) == agreed.height_px;
}

std::optional<GrabStatus> AravisDriver::Take(ArvBuffer* buffer, Frame& frame) {
  const bool whole = IsWhole(buffer);
  // The first packets come before the socket has its buffer.
  const bool excused = !whole && fresh_;
  if (whole) {
    fresh_ = false;
    // A damaged frame may have lost the packet with its number, and have that of an earlier frame.
    frame.sequence = counter_.Next(arv_buffer_get_frame_id(buffer));
    const auto stamp_ns = static_cast<std::int64_t>(arv_buffer_get_timestamp(buffer));
    // Aravis stamps arrivals with the time of day.
    HostClock& host = TheHostClock();
    const ClockReading now = host.Read();
    const std::int64_t arrival_ns = host.FromRecentTimeOfDay(
        static_cast<std::int64_t>(arv_buffer_get_system_timestamp(buffer)), now);
    frame.capture_ns =
        clock_->MiddleOfExposure(stamp_ns, arrival_ns, session_->agreed().exposure_ns,
                                 keeper_->ptp_locked(), host.OffsetNs(now));
    frame.angles = {};
    if (ReadPixels(buffer, frame)) return GrabStatus::kFrame;
  }
  session_->Push(buffer);
  if (excused) return std::nullopt;
  return GrabStatus::kTorn;
}

bool AravisDriver::ReadPixels(ArvBuffer* buffer, Frame& frame) {
  const AravisAgreement& agreed = session_->agreed();
  std::size_t bytes = 0;
  const auto* data = static_cast<const std::uint8_t*>(arv_buffer_get_image_data(buffer, &bytes));
  const RawPicture raw{agreed.format.format, agreed.width_px, agreed.height_px, 0, {data, bytes}};
  // A camera may send less than it announced.
  if (!data || bytes < LeastBytes(raw)) return false;
  if (raw.format == PixelFormat::kBgr) {
    static_assert(sizeof(Bgr) == 3 && alignof(Bgr) == 1);
    frame.image = {reinterpret_cast<const Bgr*>(data), agreed.width_px, agreed.height_px};
    lent_ = buffer;
    return true;
  }
  if (!converter_.Convert(raw, picture_)) return false;
  session_->Push(buffer);
  frame.image = picture_.view();
  return true;
}

CameraFacts AravisDriver::Facts() const {
  CameraFacts facts;
  facts.device = request_.device;
  if (!keeper_) return facts;
  facts.remarks = keeper_->Remarks();
  if (!session_) return facts;
  const AravisAgreement& agreed = session_->agreed();
  const AravisTarget& target = session_->target();
  facts.device = agreed.model + " " + agreed.serial;
  if (!target.ip.empty()) {
    facts.device += " at " + target.ip;
    if (const auto route = RouteTo(target.ip)) {
      facts.bus = route->interface;
      facts.link_mbit_s = route->link_mbit_s;
    }
  } else if (const auto usb = FindUsbDevice(agreed.serial)) {
    facts.bus = usb->controller();
    facts.link_mbit_s = usb->link_mbit_s;
  }
  facts.format = agreed.format.name;
  facts.bytes_per_frame = static_cast<double>(agreed.payload_bytes);
  facts.fps = agreed.fps;
  facts.time_source = Describe(clock_->source());
  const AravisCounters counters = session_->Counters();
  std::ranges::copy(agreed.remarks, std::back_inserter(facts.remarks));
  std::ranges::copy(session_->StreamRemarks(), std::back_inserter(facts.remarks));
  if (counters.missing_packets > 0) {
    facts.damage =
        "packets are missing; raise packet_delay_us, lower fps or give it a link of its own";
  }
  if (counters.underruns > 0) {
    facts.remarks.push_back(std::to_string(counters.underruns) +
                            " packets found no free buffer: this program is too slow for them");
  }
  return facts;
}

}  // namespace mocap
