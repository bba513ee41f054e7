#include "daemon/recording/recorder.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "daemon/base/disk_space.h"
#include "daemon/base/service_folders.h"
#include "drivers/printable_text.h"

namespace mocap {

Recorder::Recorder(RecordedStudio studio) : studio_(std::move(studio)) {
  taps_.frames.resize(studio_.cameras.size());
}

std::filesystem::path Recorder::Start(const std::string& name, const RecordingConfig& config,
                                      std::span<const RecordedPerson> people) {
  const std::scoped_lock change(change_mutex_);
  if (Status().state == RecordingStatus::State::kRunning) {
    throw std::runtime_error(Status().folder.string() +
                             " is being recorded; stop it first: mocap record stop");
  }
  const std::filesystem::path folder = TakesFolder(config) / name;
  std::shared_ptr<Recording> last;
  {
    const std::scoped_lock lock(mutex_);
    if (recording_) ended_ = recording_->Status();
    last = std::move(recording_);
  }
  // It releases the taps before the next one takes them, outside mutex_: Status does not wait.
  last.reset();
  auto recording = std::make_shared<Recording>(folder, config, studio_, people, taps_);
  const std::scoped_lock lock(mutex_);
  recording_ = std::move(recording);
  return folder;
}

RecordingStatus Recorder::Stop() {
  const std::scoped_lock change(change_mutex_);
  if (!HasTake()) throw std::runtime_error("nothing is being recorded");
  const RecordingStatus status = Status();
  return status.state == RecordingStatus::State::kRunning ? StopRunning() : status;
}

bool Recorder::HasTake() const {
  const RecordingStatus status = Status();
  return status.state == RecordingStatus::State::kRunning || !status.problem.empty();
}

void Recorder::Cancel(const std::string& name) {
  const std::scoped_lock change(change_mutex_);
  const RecordingStatus status = Status();
  const bool is_this = status.folder.stem() == name || status.folder.filename() == name;
  if (status.state != RecordingStatus::State::kRunning || !is_this)
    throw std::runtime_error("no take " + name + " is being recorded");
  const std::filesystem::path folder = StopRunning().folder;
  std::error_code error;
  std::filesystem::remove_all(folder, error);
  if (error) throw std::runtime_error(folder.string() + ": cannot be removed: " + error.message());
  const std::scoped_lock lock(mutex_);
  recording_.reset();
}

/// @pre change_mutex_ is held.
RecordingStatus Recorder::StopRunning() {
  std::shared_ptr<Recording> recording;
  {
    const std::scoped_lock lock(mutex_);
    recording = recording_;
  }
  recording->Stop();
  return recording->Status();
}

RecordingStatus Recorder::Status() const {
  const std::scoped_lock lock(mutex_);
  return recording_ ? recording_->Status() : ended_;
}

std::string CompletedText(const RecordingStatus& status) {
  std::string why = status.problem.empty() ? "" : "; it " + status.problem;
  if (status.dropped > 0) why += ": " + TextOf(status.cause.value_or(LossCause::kUnknown));
  return fmt::format("{}: {:.1f} s, {:.0f} MB, {}{}", Printable(status.folder.string()),
                     static_cast<double>(status.duration_ns) / 1e9,
                     static_cast<double>(BytesIn(status.folder)) / 1e6, ContentText(status), why);
}

std::string ContentText(const RecordingStatus& status) {
  if (status.cameras == 0) return "no frames, as mocapd has no cameras on this computer";
  const std::string cameras = Counted(status.cameras, "camera");
  const std::string sets = status.frames == 0
                               ? "no frames of " + cameras
                               : Counted(status.sets, "frame set") + " of " + cameras;
  return sets + ", " + Counted(status.dropped, "frame") + " dropped";
}

std::filesystem::path TakesFolder(const RecordingConfig& config) {
  return config.folder.empty() ? StateFolder() / "takes" : config.folder;
}

}  // namespace mocap
