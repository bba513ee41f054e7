#include "daemon/service/occupied_learner.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "config/camera_files.h"
#include "core/errors.h"
#include "daemon/service/occupied_room.h"
#include "drivers/clock.h"
#include "drivers/go_behind.h"
#include "drivers/printable_text.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/unfinished_folder.h"
#include "drivers/take/video_writer.h"

namespace mocap {
namespace {

constexpr std::size_t kOccupiedFramesQueued = 4;
/// Cameras that deliver nothing for so long are missing.
constexpr std::int64_t kOccupiedPatienceNs = 5'000'000'000;
constexpr std::chrono::milliseconds kOccupiedPause{10};

/// The recording of one camera.
class OccupiedReel {
 public:
  OccupiedReel(const std::filesystem::path& file, const CameraCalibration& camera, int wanted,
               std::int64_t interval_ns)
      : video_(file, camera.width_px, camera.height_px, kOccupiedFps, VideoPixels::kBgr),
        wanted_(wanted),
        interval_ns_(interval_ns) {}

  void Take(const TappedFrame& frame) {
    if (is_full() || frame.capture_ns < due_ns_) return;
    due_ns_ = std::max(due_ns_ + interval_ns_, frame.capture_ns);
    video_.Write(frame.image.view());
    ++written_;
  }
  void Finish() { video_.Finish(); }
  bool is_full() const { return written_ == wanted_; }
  int written() const { return written_; }

  Doorbell bell;  ///< Nobody waits for it: frames are polled.

 private:
  VideoWriter video_;
  const int wanted_;
  const std::int64_t interval_ns_;
  std::int64_t due_ns_ = 0;
  int written_ = 0;
};

/// Takes the stored background of a camera along.
void KeepStored(const std::filesystem::path& folder, const std::string& camera,
                const std::filesystem::path& partial) {
  for (const auto& entry : std::filesystem::directory_iterator(partial)) {
    if (entry.path().filename().string().starts_with(camera + '.'))
      std::filesystem::remove(entry.path());
  }
  const std::filesystem::path stored = folder / (camera + ".mkv");
  for (const std::filesystem::path& file : {stored, UnseenBeside(stored)}) {
    if (IsThere(file)) std::filesystem::copy_file(file, partial / file.filename());
  }
}

}  // namespace

OccupiedLearner::OccupiedLearner(FramePath& path, std::deque<FrameTap>& taps,
                                 KnownBackgrounds& known, LearningPlace place)
    : path_(path), taps_(taps), known_(known), place_(std::move(place)) {}

OccupiedLearner::~OccupiedLearner() {
  RequestStop();
  if (thread_.joinable()) thread_.join();
}

void OccupiedLearner::Begin(const OccupiedErrand& errand) {
  if (!place_.refusal.empty()) throw SetupError(place_.refusal);
  std::vector<std::string> names;
  for (const CameraCalibration& camera : place_.cameras) names.push_back(camera.name);
  RequireAccepted(errand.accepted, names);
  if (is_under_way_.exchange(true))
    throw std::runtime_error("the background is being learned already");
  if (thread_.joinable()) thread_.join();
  Say(fmt::format("{}recording for {:g} s\n", kUnderWay, errand.seconds));
  thread_ = std::thread([this, errand] { Run(errand); });
}

std::string OccupiedLearner::Progress() const {
  const std::scoped_lock lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
  if (text_.empty()) throw std::runtime_error("no background was learned while people moved about");
  return text_;
}

std::string OccupiedLearner::Present() const {
  const std::scoped_lock lock(mutex_);
  return is_under_way_.load() && !failure_ ? text_ : "";
}

void OccupiedLearner::Run(const OccupiedErrand& errand) {
  try {
    const std::filesystem::path partial = BeginBackground(place_.folder);
    UnfinishedFolder unfinished(partial);
    Record(errand, partial);
    GoBehind("occupied");
    const std::string text = LearnAll(errand, partial);
    ReplaceBackground(place_.folder, partial);
    unfinished.Finish();
    Use();
    spdlog::info("the background was learned while people moved about");
    Say(text);
  } catch (const std::exception& error) {
    spdlog::warn("the background was not learned: {}", error.what());
    const std::scoped_lock lock(mutex_);
    failure_ = std::current_exception();
  }
  is_under_way_.store(false);
}

void OccupiedLearner::Record(const OccupiedErrand& errand, const std::filesystem::path& partial) {
  const int wanted =
      std::min(static_cast<int>(std::lround(errand.seconds * kOccupiedFps)), kMostOccupiedPictures);
  const auto length_ns = static_cast<std::int64_t>(std::llround(errand.seconds * 1e9));
  std::deque<OccupiedReel> reels;
  for (std::size_t i = 0; i < place_.cameras.size(); ++i) {
    const CameraCalibration& camera = place_.cameras[i];
    OccupiedReel& reel =
        reels.emplace_back(partial / (camera.name + ".mkv"), camera, wanted, length_ns / wanted);
    TappedFrame item;
    item.image = Image<Bgr>(camera.width_px, camera.height_px);
    taps_[i].Open(kOccupiedFramesQueued, item, reel.bell);
  }
  const std::int64_t begin_ns = SteadyNs();
  while (!stop_.load() && !std::ranges::all_of(reels, &OccupiedReel::is_full) &&
         SteadyNs() - begin_ns < length_ns + kOccupiedPatienceNs) {
    for (std::size_t i = 0; i < reels.size(); ++i) {
      for (std::size_t n = 0; n < kOccupiedFramesQueued && taps_[i].queue().TryPop(); ++n)
        reels[i].Take(taps_[i].queue().front());
    }
    const int recorded = std::ranges::max_element(reels, {}, &OccupiedReel::written)->written();
    Say(fmt::format("{}recorded {} of {}\n", kUnderWay, recorded, Counted(wanted, "picture")));
    std::this_thread::sleep_for(kOccupiedPause);
  }
  for (FrameTap& tap : taps_) {
    tap.Close();
    tap.Free();
  }
  RequireGoing();
  for (OccupiedReel& reel : reels) reel.Finish();
}

std::string OccupiedLearner::LearnAll(const OccupiedErrand& errand,
                                      const std::filesystem::path& partial) {
  std::string text, problem;
  std::size_t held_back = 0;
  for (std::size_t i = 0; i < place_.cameras.size(); ++i) {
    const std::string& name = place_.cameras[i].name;
    Say(fmt::format("{}learning {}, {} of {}\n", kUnderWay, name, i + 1,
                    Counted(place_.cameras.size(), "camera")));
    const BackgroundSource pictures =
        PicturesOf(partial / (name + ".mkv"), 1, [this] { RequireGoing(); });
    const bool is_accepted = std::ranges::count(errand.accepted, name) > 0;
    try {
      const OccupiedRecord record =
          LearnInPlace({name, pictures, known_.Of(i), is_accepted}, partial);
      for (const std::string& line : TextOf(record)) text += line + '\n';
    } catch (const SetupError& error) {
      if (problem.empty()) problem = error.what();
      ++held_back;
      KeepStored(place_.folder, name, partial);
      text += std::string(error.what()) + ". Its background remains as it was\n";
    }
  }
  if (held_back == place_.cameras.size()) throw SetupError(problem);
  return text;
}

void OccupiedLearner::Use() {
  for (std::size_t i = 0; i < place_.cameras.size(); ++i) {
    const CameraCalibration& camera = place_.cameras[i];
    const std::filesystem::path base = place_.folder / camera.name;
    known_.Set(i, OpenCameraBackground(base.string() + ".mkv", base.string() + ".csv", camera));
    path_.ReplaceBackground(static_cast<int>(i), known_.Of(i)());
  }
}

void OccupiedLearner::Say(const std::string& text) {
  const std::scoped_lock lock(mutex_);
  failure_ = nullptr;
  text_ = text;
}

void OccupiedLearner::RequireGoing() const {
  if (stop_.load()) throw std::runtime_error("mocapd is stopping; the previous background is kept");
}

}  // namespace mocap
