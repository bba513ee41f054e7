#include "daemon/recording/recording.h"

#include <fmt/format.h>
#include <pthread.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "config/subject_file.h"
#include "core/errors.h"
#include "daemon/base/disk_space.h"
#include "daemon/base/free_memory.h"
#include "drivers/clock.h"
#include "drivers/go_behind.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/text_file.h"
#include "drivers/utc_time.h"

namespace mocap {
namespace {

constexpr std::chrono::milliseconds kKeeperTick{100};
constexpr std::chrono::milliseconds kHeldTick{5};
constexpr std::int64_t kSafeEveryNs = 300'000'000;
constexpr std::size_t kFewestFrames = 2;
constexpr std::size_t kLongestThreadName = 15;

constexpr const char* NameOf(VideoCodec codec) {
  switch (codec) {
    case VideoCodec::kHuffYuv:
      return "huffyuv";
    case VideoCodec::kFfv1:
      return "ffv1";
    case VideoCodec::kRaw:
      return "raw";
  }
  return "";
}

double Memory_mb() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)) /
         1e6;
}

TakeDescription DescriptionOf(const std::filesystem::path& folder, const RecordingConfig& config,
                              const RecordedStudio& studio) {
  TakeDescription description{.name = folder.filename(),
                              .fps_nominal = studio.fps_nominal,
                              .cameras = {},
                              .notes = {{"created", UtcText(TimeOfDayS())},
                                        {"recorded_by", std::string("mocapd ") + MOCAP_VERSION},
                                        {"studio", studio.name}},
                              .codec = config.codec};
  for (const RecordedCamera& camera : studio.cameras) {
    description.cameras.push_back(camera.calibration);
  }
  return description;
}

/// Checks before anything is created.
const std::filesystem::path& WithRoom(const std::filesystem::path& folder,
                                      const RecordingConfig& config) {
  const auto free_mb = static_cast<double>(BytesFree(folder.parent_path())) / 1e6;
  if (free_mb < config.keep_free_mb) {
    throw SetupError(fmt::format("{}: has {:.0f} MB left, and recording.keep_free_mb is {:.0f}",
                                 folder.parent_path().string(), free_mb, config.keep_free_mb));
  }
  return folder;
}

}  // namespace

double BufferFor(const RecordingConfig& config, double memory_mb) {
  return std::min(config.buffer_mb, memory_mb / 2);
}

/// State of one camera.
struct Recording::Line {
  Coder coder;
  Doorbell bell;
  std::optional<SafeFile> video, table;
  std::atomic<std::int64_t> frames{0};
  std::atomic<std::int64_t> refused{0};  ///< Times that did not increase.
  std::atomic<std::int64_t> missing{0};  ///< Gaps in the camera's count, whatever the cause.
  std::atomic<std::int64_t> dropped{0};  ///< No room in memory.
  // Used by the camera's thread only:
  std::optional<std::uint64_t> next_sequence;
  std::int64_t last_ns = -1;
};

Recording::Recording(const std::filesystem::path& folder, const RecordingConfig& config,
                     const RecordedStudio& studio, std::span<const RecordedPerson> people,
                     RecordingTaps& taps)
    : config_(config),
      studio_(studio),
      taps_(taps),
      writer_(std::in_place, WithRoom(folder, config), DescriptionOf(folder, config, studio)),
      folder_(folder),
      partial_(writer_->partial_folder()),
      backgrounds_(static_cast<std::ptrdiff_t>(studio.cameras.size())),
      place_(partial_),
      can_return_(MayComeForward()) {
  try {
    Prepare(people);
  } catch (...) {
    Discard();
    throw;
  }
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    lines_[i]->coder.thread = std::thread([this, i] { RunCamera(i); });
  }
  backgrounds_.wait();
  // A take opens only with its description, calibration and background.
  Guard([&] { SyncFileSystem(partial_); });
  Begin();
  if (has_failed_.load()) {
    Stop();
    if (Status().frames == 0) Discard();
    throw std::runtime_error(Status().problem);
  }
}

// Frees the name for another attempt.
void Recording::Discard() {
  CloseFiles();
  std::error_code error;
  std::filesystem::remove_all(partial_, error);
}

void Recording::Prepare(std::span<const RecordedPerson> people) {
  const TakeLayout layout{partial_};
  if (!studio_.config_text.empty()) WriteText(layout.Config(), studio_.config_text);
  for (const RecordedPerson& person : people) {
    // Sizes stored for the whole take apply to whoever is in it.
    const std::filesystem::path file =
        people.size() == 1 ? layout.Subject() : layout.Subject(person.id);
    MakeFolder(file.parent_path());
    SaveSubject(file, person.sizes, person.name);
  }
  messages_.emplace(partial_, taps_);
  safe_log_.emplace(layout.Poses());
  for (const RecordedCamera& camera : studio_.cameras) {
    Line& line = *lines_.emplace_back(std::make_unique<Line>());
    line.video.emplace(layout.Video(camera.calibration.name));
    line.table.emplace(layout.Table(camera.calibration.name));
  }
}

void Recording::Begin() {
  begin_ns_ = SteadyNs();
  if (studio_.times == CaptureTimes::kPresent) time_of_day_ahead_ns_ = TheHostClock().OffsetNs();
  const double all_mb = BufferFor(config_, Memory_mb());
  if (all_mb < config_.buffer_mb) {
    spdlog::warn("recording.buffer_mb is {:.0f}, but only {:.0f} are used: half of the memory",
                 config_.buffer_mb, all_mb);
  }
  const double buffer_mb = all_mb / static_cast<double>(lines_.size());
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const CameraCalibration& camera = studio_.cameras[i].calibration;
    TappedFrame item;
    item.image = Image<Bgr>(camera.width_px, camera.height_px);
    const double frame_mb = 3e-6 * camera.width_px * camera.height_px;
    const auto fitting = static_cast<std::size_t>(buffer_mb / frame_mb);
    taps_.frames[i].Open(std::clamp(fitting, kFewestFrames, FrameTap::Queue::kMostCapacity), item,
                         lines_[i]->bell);
    lines_[i]->coder.tap = &taps_.frames[i];
  }
  messages_->Open(keeper_bell_);
  std::vector<Coder*> coders;
  for (const auto& line : lines_) coders.push_back(&line->coder);
  watch_.emplace(std::move(coders), can_return_);
  begun_.count_down();
  keeper_ = std::thread([this] { RunKeeper(); });
}

Recording::~Recording() { Stop(); }

void Recording::Stop() {
  stop_.store(true);
  if (keeper_.joinable()) keeper_.join();
}

void Recording::End() {
  std::int64_t running = 0;
  end_ns_.compare_exchange_strong(running, SteadyNs());
  stop_.store(true);
}

void Recording::Fail(const std::string& problem) {
  End();
  has_failed_.store(true);
  const std::scoped_lock lock(mutex_);
  if (problem_.empty()) {
    problem_ = problem;
    spdlog::error("recording {}: {}", folder_.filename().c_str(), problem);
  }
}

template <typename Body>
void Recording::Guard(Body body) {
  try {
    body();
  } catch (const std::exception& error) {
    Fail(error.what());
  }
}

void Recording::RunCamera(std::size_t camera) {
  const RecordedCamera& recorded = studio_.cameras[camera];
  const std::string name = "rec " + recorded.calibration.name;
  pthread_setname_np(pthread_self(), name.substr(0, kLongestThreadName).c_str());
  // The caller waits for this.
  Guard([&] {
    std::int64_t time_ns = 0;
    recorded.background.ForEach([&](const BackgroundFrame& frame) {
      if (time_ns == 0 && frame.unseen.BoundingBox())
        writer_->WriteUnseen(static_cast<int>(camera), frame.unseen);
      writer_->WriteBackground(static_cast<int>(camera), frame.image.view(), time_ns++,
                               frame.angles);
    });
  });
  backgrounds_.count_down();
  begun_.wait();
  // A thread whose priority cannot be raised again would have to wait while others have work.
  if (can_return_) GoBehind(name);
  lines_[camera]->coder.id.store(gettid());
  Guard([&] { WriteFrames(camera); });
}

void Recording::WriteFrames(std::size_t camera) {
  Line& line = *lines_[camera];
  Coder& coder = line.coder;
  FrameTap::Queue& queue = coder.tap->queue();
  while (true) {
    const int seen = line.bell.count();
    const bool is_closed = queue.closed();
    // Poses have priority as long as no frame is dropped for them.
    if (coder.tap->is_held() && !is_closed && !coder.IsHalfFull()) {
      std::this_thread::sleep_for(kHeldTick);
      continue;
    }
    line.dropped.store(queue.dropped(), std::memory_order_relaxed);
    if (!queue.TryPop()) {
      if (is_closed) return;
      line.bell.WaitPast(seen);
      continue;
    }
    WriteFrame(camera, queue.front());
    coder.done.fetch_add(1, std::memory_order_release);
  }
}

void Recording::WriteFrame(std::size_t camera, const TappedFrame& frame) {
  Line& line = *lines_[camera];
  const int number = static_cast<int>(camera);
  if (frame.capture_ns <= line.last_ns) {
    line.refused.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  if (line.next_sequence && frame.sequence > *line.next_sequence) {
    const std::uint64_t gap = frame.sequence - *line.next_sequence;
    writer_->SkipFrames(number, gap);
    line.missing.fetch_add(static_cast<std::int64_t>(gap), std::memory_order_relaxed);
  }
  line.next_sequence = frame.sequence + 1;
  line.last_ns = frame.capture_ns;
  writer_->WriteFrame(number, frame.image.view(), frame.capture_ns + time_of_day_ahead_ns_,
                      frame.angles);
  line.frames.fetch_add(1, std::memory_order_relaxed);
}

void Recording::RunKeeper() {
  pthread_setname_np(pthread_self(), "rec keeper");
  Guard([&] { KeepUntilStopped(); });
  End();
  messages_->Close();
  for (FrameTap& tap : taps_.frames) tap.Close();
  EndWatch();
  Guard([&] { messages_->Write(time_of_day_ahead_ns_); });
  for (const auto& line : lines_) line->coder.thread.join();
  Complete();
  for (FrameTap& tap : taps_.frames) tap.Free();
  GiveBackFreeMemory();
}

// No more frames are dropped, and the caller waits for the rest.
void Recording::EndWatch() {
  const std::scoped_lock lock(mutex_);
  last_cause_ = watch_->cause();
  watch_.reset();
  if (!can_return_) return;
  for (const auto& line : lines_) BringForward(line->coder.thread);
}

void Recording::KeepUntilStopped() {
  std::int64_t safe_ns = SteadyNs();
  while (!stop_.load()) {
    std::this_thread::sleep_for(kKeeperTick);
    RequireStillThere(partial_);
    messages_->Write(time_of_day_ahead_ns_);
    if (SteadyNs() - safe_ns < kSafeEveryNs) continue;
    safe_ns = SteadyNs();
    KeepSafe();
  }
}

void Recording::KeepSafe() {
  for (const auto& line : lines_) {
    line->video->Sync();
    line->table->Sync();
    // Nobody reads it soon. Others need the page cache more.
    line->video->Forget();
  }
  safe_log_->Sync();
  const auto free_mb = static_cast<double>(BytesFree(partial_)) / 1e6;
  if (free_mb >= config_.keep_free_mb) return;
  End();
  const std::scoped_lock lock(mutex_);
  if (!problem_.empty()) return;
  problem_ = fmt::format("ended because the disk has {:.0f} MB left", free_mb);
  spdlog::warn("recording {} {}", folder_.filename().c_str(), problem_);
}

void Recording::Complete() {
  Guard([&] {
    if (has_failed_.load()) return;
    std::vector<std::pair<std::string, std::string>> notes = {{"codec", NameOf(config_.codec)}};
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const Line& line = *lines_[i];
      const std::string& name = studio_.cameras[i].calibration.name;
      notes.emplace_back("frames_" + name, std::to_string(line.frames));
      notes.emplace_back("missing_frames_" + name, std::to_string(line.missing + line.refused));
      notes.emplace_back("dropped_while_recording_" + name, std::to_string(line.dropped));
    }
    const std::int64_t step_ns = TheHostClock().OffsetNs() - time_of_day_ahead_ns_;
    if (studio_.times == CaptureTimes::kPresent && step_ns != 0) {
      notes.emplace_back("clock_was_set_meanwhile_by_ns", std::to_string(step_ns));
    }
    if (last_cause_) notes.emplace_back("dropped_because", TextOf(*last_cause_));
    writer_->AddNotes(notes);
    writer_->Finish();
    const std::scoped_lock lock(mutex_);
    place_ = folder_;
  });
  CloseFiles();
  Guard([&] { SyncFileSystem(place_); });
  const std::scoped_lock lock(mutex_);
  state_ = has_failed_.load() ? RecordingStatus::State::kFailed : RecordingStatus::State::kComplete;
}

// A removed take with open files would keep filling the disk.
void Recording::CloseFiles() {
  writer_.reset();
  messages_.reset();
  safe_log_.reset();
  for (const auto& line : lines_) {
    line->video.reset();
    line->table.reset();
  }
}

RecordingStatus Recording::Status() const {
  RecordingStatus status;
  const std::int64_t end_ns = end_ns_.load();
  status.duration_ns = (end_ns > 0 ? end_ns : SteadyNs()) - begin_ns_;
  status.cameras = lines_.size();
  for (const auto& line : lines_) {
    const std::int64_t frames = line->frames.load(std::memory_order_relaxed);
    status.frames += frames;
    status.sets = std::max(status.sets, frames);
    status.dropped += line->dropped.load(std::memory_order_relaxed);
  }
  const std::scoped_lock lock(mutex_);
  if (state_ == RecordingStatus::State::kRunning && begin_ns_ > 0) {
    for (const auto& line : lines_) status.waiting += line->coder.Waiting();
  }
  status.cause = watch_ ? watch_->cause() : last_cause_;
  status.state = state_;
  status.problem = problem_;
  status.folder = place_;
  return status;
}

}  // namespace mocap
