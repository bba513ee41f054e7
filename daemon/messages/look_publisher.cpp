#include "daemon/messages/look_publisher.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "daemon/messages/reduced_picture.h"
#include "drivers/clock.h"
#include "drivers/go_behind.h"

namespace mocap {
namespace {

constexpr int kLookQuality = 90;
/// How long a camera's frame is waited for, and how often it is checked for.
constexpr std::int64_t kFrameWaitNs = 200'000'000;
constexpr std::chrono::milliseconds kLookTick{5};
/// Whoever was seen earlier is elsewhere by now.
constexpr std::int64_t kPlacesHoldNs = 500'000'000;

void PlacePeople(const TrackedSet& set, PlacedPeople& placed) {
  placed.steady_ns = SteadyNs();
  placed.count = 0;
  for (const PersonView& person : set.people) {
    if (person.capture->result().state != CaptureState::kTracking) continue;
    if (placed.people.size() == placed.count) placed.people.emplace_back();
    PlacedPeople::Person& place = placed.people[placed.count++];
    const BodyModel& body = person.capture->body();
    place.id = person.id;
    body.PoseShape(body.PostureAt(person.capture->result().pose), place.capsules);
  }
}

}  // namespace

LookPublisher::LookPublisher(LcmSender& sender, const LcmConfig& config,
                             std::vector<CameraCalibration> cameras, CaptureTimes times)
    : sender_(sender),
      channel_(config.prefix + "MOCAP_LOOK"),
      cameras_(std::move(cameras)),
      times_(times),
      taps_(cameras_.size()),
      thread_([this] { Run(); }) {}

LookPublisher::~LookPublisher() {
  stop_.store(true);
  bell_.Ring();
  thread_.join();
}

void LookPublisher::OnSet(const TrackedSet& set) {
  people_tap_.Offer([&set](PlacedPeople& copy) {
    PlacePeople(set, copy);
    return true;
  });
}

void LookPublisher::Ask(const look_request_t& request) {
  {
    const std::scoped_lock lock(wants_mutex_);
    wants_.Take(request, SteadyNs());
  }
  bell_.Ring();
}

std::optional<LookWant> LookPublisher::Want() {
  const std::scoped_lock lock(wants_mutex_);
  return wants_.At(SteadyNs());
}

void LookPublisher::Run() {
  // A start may be ended at once; busy processors would delay the end of an idle thread.
  bell_.WaitPast(0);
  GoBehind("looks");
  while (!stop_.load()) {
    const int seen = bell_.count();
    const std::optional<LookWant> want = Want();
    OpenOrClose(want.has_value());
    if (!want) {
      // The destructor may have rung before.
      if (!stop_.load()) bell_.WaitPast(seen);
      continue;
    }
    const std::int64_t begin_ns = SteadyNs();
    Look(*want);
    WaitUntil(begin_ns + static_cast<std::int64_t>(1e9 / want->rate_hz));
  }
  OpenOrClose(false);
}

void LookPublisher::WaitUntil(std::int64_t steady_ns) const {
  while (!stop_.load() && SteadyNs() < steady_ns)
    std::this_thread::sleep_for(std::min<std::chrono::nanoseconds>(
        kLookTick, std::chrono::nanoseconds(std::max<std::int64_t>(0, steady_ns - SteadyNs()))));
}

void LookPublisher::OpenOrClose(bool is_wanted) {
  if (is_wanted == is_open_) return;
  is_open_ = is_wanted;
  if (is_wanted) return people_tap_.Open(1, {}, people_bell_);
  people_tap_.Close();
  people_tap_.Free();
  people_.count = 0;
}

void LookPublisher::Look(const LookWant& want) {
  if (people_tap_.queue().TryPop()) std::swap(people_, people_tap_.queue().front());
  if (cameras_.empty() || people_.count == 0 || SteadyNs() - people_.steady_ns > kPlacesHoldNs)
    return;
  const std::size_t camera = turn_++ % cameras_.size();
  if (!TakeFrame(camera)) return;
  for (std::size_t i = 0; i < people_.count && !stop_.load(); ++i) {
    const PlacedPeople::Person& person = people_.people[i];
    if (want.person == 0 || want.person == person.id) Publish(camera, person, want);
  }
}

/// The tap is open for one frame only: a copy of each would cost time in the camera's thread.
bool LookPublisher::TakeFrame(std::size_t camera) {
  FrameTap& tap = taps_[camera];
  frame_.image = Image<Bgr>(cameras_[camera].width_px, cameras_[camera].height_px);
  Doorbell bell;
  tap.Open(1, frame_, bell);
  const std::int64_t end_ns = SteadyNs() + kFrameWaitNs;
  while (!stop_.load() && bell.count() == 0 && SteadyNs() < end_ns)
    std::this_thread::sleep_for(kLookTick);
  tap.Close();
  const bool has_frame = tap.queue().TryPop();
  if (has_frame) std::swap(frame_, tap.queue().front());
  tap.Free();
  return has_frame;
}

void LookPublisher::Publish(std::size_t camera, const PlacedPeople::Person& person,
                            const LookWant& want) {
  const CameraCalibration& calibration = cameras_[camera];
  const std::optional<LookRegion> region =
      RegionAround(person.capsules, calibration, calibration.PoseAt(frame_.angles));
  if (!region) return;
  CutRegion(frame_.image.view(), *region, cut_);
  const bool is_present = times_ == CaptureTimes::kPresent;
  look_.capture_ns = frame_.capture_ns + (is_present ? TheHostClock().OffsetNs() : 0);
  look_.camera = calibration.name;
  look_.person = person.id;
  look_.left_px = region->left_px;
  look_.top_px = region->top_px;
  look_.side_px = region->side_px;
  look_.reduction = want.side_px > 0 ? ReductionFor(region->side_px, want.side_px) : 1;
  for (int axis = 0; axis < 2; ++axis) look_.up[axis] = region->up[axis];
  ReducePicture(cut_.view(), look_.reduction, reduced_);
  look_.width_px = reduced_.width();
  if (want.is_raw) {
    look_.encoding = look_t::BGR;
    const auto* pixels = reinterpret_cast<const std::uint8_t*>(reduced_.pixels().data());
    look_.picture.assign(pixels, pixels + sizeof(Bgr) * reduced_.pixels().size());
  } else {
    look_.encoding = look_t::JPEG;
    encoder_.Encode(reduced_.view(), kLookQuality, look_.picture);
  }
  look_.num_bytes = static_cast<std::int32_t>(look_.picture.size());
  sender_.Send(channel_, look_, bytes_);
}

}  // namespace mocap
