#include "drivers/aravis/aravis_keeper.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include "core/errors.h"
#include "drivers/aravis/gige_probe.h"
#include "drivers/clock.h"

namespace mocap {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kWatchPeriod{20};
constexpr milliseconds kPresencePatience{100};
/// A camera is lost after it missed this many frames, and not before kLeastSilence: the host may be
/// busy.
constexpr double kMissedFrames = 4;
constexpr milliseconds kLeastSilence{100};
/// The first frame may take longer.
constexpr milliseconds kGraceAfterOpening{1000};
/// After a cut link, a camera continues by itself. One that answers but stays silent does not.
constexpr milliseconds kStalled{1500};
constexpr milliseconds kBetweenAttempts{200};
/// Probing too often would keep the current owner's control alive.
constexpr milliseconds kBetweenLooksWhenHeld{4000};
constexpr std::chrono::seconds kBetweenSearches{5};
constexpr std::chrono::seconds kPtpPeriod{1};
constexpr milliseconds kAnswerPatience{10};

milliseconds SilenceLimit(const AravisAgreement& agreed) {
  const auto missed_ms =
      static_cast<std::int64_t>(kMissedFrames * 1000 / std::max(agreed.fps, 0.1));
  return std::max(kLeastSilence, milliseconds(missed_ms));
}

/// Waits until the session has no other user, then closes the camera.
void Close(AravisKeeper::Session session) {
  while (session.use_count() > 1) std::this_thread::sleep_for(milliseconds(1));
  session.reset();
}

/// Returns the next trigger time on the timeline. It is the same on all hosts whose time of day
/// agrees.
std::int64_t NextTrigger(double fps) {
  const std::int64_t period_ns = std::llround(1e9 / fps);
  const std::int64_t now_ns = TimelineNs();
  const std::int64_t time_of_day_ns = TheHostClock().ToTimeOfDay(now_ns);
  return now_ns + period_ns - time_of_day_ns % period_ns;
}

}  // namespace

AravisKeeper::AravisKeeper(const CameraRequest& request, const AravisSettings& settings,
                           Session session)
    : request_(request), settings_(settings), target_(session->target()) {
  session_ = std::move(session);
}

void AravisKeeper::Start() {
  Install(std::exchange(session_, nullptr));
  std::thread([self = shared_from_this()] { self->Run(); }).detach();
}

AravisKeeper::Session AravisKeeper::session() const {
  const std::lock_guard lock(mutex_);
  return session_;
}

std::vector<std::string> AravisKeeper::Remarks() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> remarks;
  if (!trouble_.empty()) remarks.push_back(trouble_);
  if (!trigger_trouble_.empty()) remarks.push_back(trigger_trouble_);
  const bool is_scheduled = settings_.is_scheduled();
  const bool is_master = is_scheduled && ptp_status_ == "Master";
  if (!ptp_status_.empty() && !ptp_locked() && !is_master) {
    remarks.push_back("PTP is " + ptp_status_ + ": without a master on its network " +
                      (is_scheduled
                           ? "it is triggered by its own clock, out of step with the others"
                           : "its own clock is fitted"));
  }
  return remarks;
}

void AravisKeeper::RequestStop() {
  stopping_.store(true, std::memory_order_relaxed);
  changed_.notify_all();
}

bool AravisKeeper::WaitClosed(milliseconds timeout) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, timeout, [this] { return closed_; });
}

void AravisKeeper::Pause(milliseconds pause) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, pause, [this] { return stopping(); });
}

void AravisKeeper::Run() {
  while (!stopping()) {
    Pause(kWatchPeriod);
    if (stopping()) break;
    if (!IsSilent()) {
      answered_.reset();
      lost_.store(false, std::memory_order_relaxed);
    } else if (target_.ip.empty()) {
      SeekUsb();
    } else {
      SeekGige();
    }
  }
  Retire();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return closing_ == 0; });
  closed_ = true;
  changed_.notify_all();
}

bool AravisKeeper::IsSilent() {
  const Session session = this->session();
  if (!session) return true;
  const std::uint64_t signs = session->SignsOfLife();
  if (std::exchange(signs_, signs) != signs) last_sign_ = Clock::now();
  return session->control_lost() || Clock::now() - last_sign_ > SilenceLimit(session->agreed());
}

void AravisKeeper::SeekGige() {
  const Session session = this->session();
  // The camera is held by another program, perhaps one that died.
  if (!session && Clock::now() < next_look_) return;
  const GigePresence presence = ProbeGigeCamera(target_.ip, kPresencePatience);
  const bool waits_for_trigger = !settings_.trigger.empty() && session && !session->control_lost();
  if (waits_for_trigger && presence == GigePresence::kHeld) return;
  lost_.store(true, std::memory_order_relaxed);
  if (presence == GigePresence::kAbsent) {
    answered_.reset();
    FindAgain();
    return;
  }
  if (presence == GigePresence::kFree) {
    Reopen();
    return;
  }
  const Clock::time_point now = Clock::now();
  if (!answered_) answered_ = now;
  if (session && (session->control_lost() || now - *answered_ > kStalled)) Retire();
  const std::lock_guard lock(mutex_);
  if (!session_ && closing_ == 0) {
    trouble_ = "is controlled by another program";
    next_look_ = now + kBetweenLooksWhenHeld;
  }
}

void AravisKeeper::SeekUsb() {
  const Session session = this->session();
  if (session && !session->control_lost() && !settings_.trigger.empty()) return;
  lost_.store(true, std::memory_order_relaxed);
  // USB allows a device to be opened only once.
  Retire();
  {
    const std::lock_guard lock(mutex_);
    if (closing_ > 0) return;
  }
  Reopen();
}

void AravisKeeper::FindAgain() {
  if (IsIpv4(target_.device) || Clock::now() < next_search_) return;
  next_search_ = Clock::now() + kBetweenSearches;
  try {
    // Its address may have changed.
    const AravisTarget found = FindAravisCamera(target_.device);
    target_.ip = found.ip;
  } catch (const SetupError&) {
    // Still away.
  }
}

void AravisKeeper::Reopen() {
  Retire();
  try {
    Install(std::make_shared<AravisSession>(target_, request_, settings_));
  } catch (const SetupError& error) {
    {
      const std::lock_guard lock(mutex_);
      trouble_ = error.what();
    }
    Pause(kBetweenAttempts);
  }
}

void AravisKeeper::Install(Session session) {
  signs_ = session->SignsOfLife();
  last_sign_ = Clock::now() + kGraceAfterOpening;
  answered_.reset();
  unsigned generation = 0;
  {
    const std::lock_guard lock(mutex_);
    session_ = session;
    trouble_.clear();
    trigger_trouble_.clear();
    generation = generation_.fetch_add(1, std::memory_order_release) + 1;
  }
  changed_.notify_all();
  if (settings_.trigger != "software" && session->agreed().ptp_status.empty()) return;
  std::thread([self = shared_from_this(), session = std::move(session), generation] {
    self->Speak(session, generation);
  }).detach();
}

void AravisKeeper::Retire() {
  const std::lock_guard lock(mutex_);
  if (!session_) return;
  generation_.fetch_add(1, std::memory_order_release);
  ++closing_;
  std::thread([self = shared_from_this(), session = std::exchange(session_, nullptr)]() mutable {
    Close(std::move(session));
    const std::lock_guard lock_closing(self->mutex_);
    --self->closing_;
    self->changed_.notify_all();
  }).detach();
}

void AravisKeeper::Speak(const Session& session, unsigned generation) {
  ExposureSchedule schedule(request_.fps);
  GigeActionSender sender(session->target().ip);
  Clock::time_point next_ptp = Clock::now();
  while (!stopping() && generation_.load(std::memory_order_acquire) == generation) {
    if (!session->agreed().ptp_status.empty() && Clock::now() >= next_ptp) {
      NotePtp(session->PtpStatus());
      const auto ahead_ns = settings_.is_scheduled() ? session->ClockAheadNs() : std::nullopt;
      if (ahead_ns) schedule.SetOffset(*ahead_ns);
      next_ptp = Clock::now() + kPtpPeriod;
    }
    if (settings_.trigger == "software") {
      SleepUntil(NextTrigger(request_.fps));
      session->Trigger();
    } else if (schedule.knows_time()) {
      ScheduleNext(schedule, sender);
    } else {
      if (settings_.is_scheduled())
        NoteTrigger("does not report its time, which its trigger needs");
      Pause(kWatchPeriod);
    }
  }
}

void AravisKeeper::ScheduleNext(ExposureSchedule& schedule, GigeActionSender& sender) {
  const std::int64_t exposure_ns = schedule.Next(TimelineNs());
  SleepUntil(schedule.AskAt());
  NoteTrigger(Describe(sender.Schedule(exposure_ns, kAnswerPatience)));
}

void AravisKeeper::NoteTrigger(const std::string& trouble) {
  const std::lock_guard lock(mutex_);
  trigger_trouble_ = trouble;
}

void AravisKeeper::NotePtp(const std::string& status) {
  const bool locked = status == "Slave";
  ptp_locked_.store(locked, std::memory_order_relaxed);
  const std::lock_guard lock(mutex_);
  ptp_status_ = status;
}

}  // namespace mocap
