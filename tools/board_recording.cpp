#include "tools/board_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <fstream>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "core/errors.h"
#include "drivers/clock.h"
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"
#include "drivers/take/unfinished_folder.h"
#include "drivers/take/video_writer.h"

namespace mocap {
namespace {

constexpr std::chrono::milliseconds kBoardGrabTimeout{200};
constexpr std::chrono::milliseconds kLookInterval{50};
constexpr std::size_t kKeptPictures = 3;

/// A frame's index on the common beat of all cameras, and its pixels.
struct BeatPicture {
  std::int64_t beat = 0;
  Image<Bgr> picture;
};

/// Records one camera in its own thread, and keeps its newest pictures for the detector.
class CameraRecording {
 public:
  CameraRecording(LiveCamera& camera, const BoardRecordingOptions& options)
      : camera_(camera),
        base_(options.folder / camera.name),
        fps_(options.frames_per_second),
        beat_ns_(std::llround(1e9 / options.frames_per_second)),
        table_(base_.string() + ".csv") {
    table_ << "frame,timestamp_ns" << (camera.head ? ",pan_rad,tilt_rad" : "") << '\n';
  }

  void Run(const std::atomic<bool>& stop) {
    camera_.driver->Start();
    Frame frame;
    std::int64_t last_beat = -1;
    do {
      const GrabStatus status = camera_.driver->Grab(frame, kBoardGrabTimeout);
      if (status == GrabStatus::kEnd) break;
      if (status != GrabStatus::kFrame) continue;
      const std::int64_t beat = frame.capture_ns / beat_ns_;
      if (beat <= last_beat) continue;
      last_beat = beat;
      Write(frame);
      Keep(beat, frame.image);
    } while (!stop);
    camera_.driver->Stop();
    Finish();
  }

  std::int64_t NewestBeat() const {
    const std::scoped_lock lock(mutex_);
    return kept_.empty() ? -1 : kept_.back().beat;
  }

  std::optional<Image<Bgr>> PictureAt(std::int64_t beat) const {
    const std::scoped_lock lock(mutex_);
    const auto kept = std::ranges::find(kept_, beat, &BeatPicture::beat);
    return kept == kept_.end() ? std::nullopt : std::optional(kept->picture);
  }

 private:
  void Write(const Frame& frame) {
    const int width = frame.image.width(), height = frame.image.height();
    if (!video_) {
      video_.emplace(base_.string() + ".mkv", width, height, fps_, VideoPixels::kGray);
      gray_ = Image<std::uint8_t>(width, height);
    }
    for (int y = 0; y < height; ++y) {
      const Bgr* from = frame.image.row(y);
      std::uint8_t* to = gray_.row(y);
      // Rec. 601, as board detectors use.
      for (int x = 0; x < width; ++x)
        to[x] = static_cast<std::uint8_t>(
            (1868 * from[x].b + 9617 * from[x].g + 4899 * from[x].r + 8192) >> 14);
    }
    video_->Write(gray_.view());
    table_ << frames_++ << ',' << frame.capture_ns;
    if (camera_.head) table_ << fmt::format(",{},{}", frame.angles.pan_rad, frame.angles.tilt_rad);
    table_ << '\n';
  }

  void Keep(std::int64_t beat, ImageView<const Bgr> image) {
    BeatPicture kept{beat, Image<Bgr>(image.width(), image.height())};
    for (int y = 0; y < image.height(); ++y)
      std::copy_n(image.row(y), image.width(), kept.picture.row(y));
    const std::scoped_lock lock(mutex_);
    kept_.push_back(std::move(kept));
    if (kept_.size() > kKeptPictures) kept_.pop_front();
  }

  void Finish() {
    if (frames_ == 0)
      throw std::runtime_error(camera_.name + " (" + camera_.request.device +
                               ") has delivered no frame");
    video_->Finish();
    table_.close();
    if (!table_) throw std::runtime_error(base_.string() + ".csv: cannot be written");
  }

  LiveCamera& camera_;
  const std::filesystem::path base_;
  const double fps_;
  const std::int64_t beat_ns_;
  std::ofstream table_;
  std::optional<VideoWriter> video_;
  Image<std::uint8_t> gray_;
  int frames_ = 0;
  mutable std::mutex mutex_;
  std::deque<BeatPicture> kept_;
};

using Recordings = std::vector<std::unique_ptr<CameraRecording>>;

/// Searches for the board in all cameras, beat by beat, as fast as possible.
class Looker {
 public:
  Looker(const Board& board, const std::vector<LiveCamera>& cameras) : detector_(board) {
    seen_.board = board;
    for (const LiveCamera& camera : cameras) seen_.cameras.push_back({camera.name, 1, 1, 0, ""});
  }

  /// @return  false when there is no new beat.
  bool Look(const Recordings& recordings) {
    std::int64_t newest = -1;
    for (const auto& recording : recordings) newest = std::max(newest, recording->NewestBeat());
    // The beat before: every camera has it by now.
    const std::int64_t beat = newest - 1;
    if (beat <= last_beat_) return false;
    last_beat_ = beat;
    // It takes longer than a search.
    doubted_ = (doubted_ + 1) % recordings.size();
    for (std::size_t c = 0; c < recordings.size(); ++c) {
      const std::optional<Image<Bgr>> picture = recordings[c]->PictureAt(beat);
      if (!picture) continue;
      seen_.cameras[c].width_px = picture->width();
      seen_.cameras[c].height_px = picture->height();
      auto corners = detector_.Detect(picture->view(), Effort::kQuick);
      if (!corners) {
        if (c == doubted_) Doubt(c, *picture);
        continue;
      }
      BoardDetection& detection = seen_.detections.emplace_back();
      detection.camera = static_cast<int>(c);
      detection.moment = seen_.moments;
      detection.corners = std::move(*corners);
    }
    ++seen_.moments;
    return true;
  }

  std::vector<CameraHint> Hints() const { return HintsFor(seen_); }

 private:
  // Finds out why a camera has not seen the board yet.
  void Doubt(std::size_t camera, const Image<Bgr>& picture) {
    if (seen_.CountOf(static_cast<int>(camera)) > 0) return;
    if (const auto why = detector_.WhyNot(picture.view()))
      seen_.cameras[camera].mismatch = why->text;
  }

  BoardDetector detector_;
  BoardDetections seen_;
  std::int64_t last_beat_ = -1;
  std::size_t doubted_ = 0;
};

/// Stops threads when the block that waits for them is left in any way.
struct StopAtEnd {
  std::atomic<bool>& stop;
  ~StopAtEnd() { stop = true; }
};

/// Keeps the folder of a recording that has pictures, whatever ends it: a board is carried once.
struct KeepAtEnd {
  const Recordings& recordings;
  UnfinishedFolder& folder;
  ~KeepAtEnd() {
    if (std::ranges::any_of(recordings, [](const auto& r) { return r->NewestBeat() >= 0; }))
      folder.Finish();
  }
};

bool AnyEnded(const std::vector<std::future<void>>& threads) {
  return std::ranges::any_of(threads, [](const std::future<void>& thread) {
    return thread.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  });
}

}  // namespace

void RequireNew(const std::filesystem::path& folder) {
  if (IsThere(folder))
    throw SetupError(folder.string() + ": exists already; expected another folder to record into");
}

void RecordBoard(std::vector<LiveCamera>& cameras, const BoardRecordingOptions& options,
                 const HintListener& listener) {
  RequireNew(options.folder);
  std::filesystem::create_directories(options.folder);
  UnfinishedFolder unfinished(options.folder);
  Looker looker(options.board, cameras);
  Recordings recordings;
  for (LiveCamera& camera : cameras)
    recordings.push_back(std::make_unique<CameraRecording>(camera, options));
  const KeepAtEnd keep_at_end{recordings, unfinished};
  std::atomic<bool> stop = false;
  std::vector<std::future<void>> threads;
  {
    const StopAtEnd stop_at_end{stop};
    for (const auto& recording : recordings)
      threads.push_back(
          std::async(std::launch::async, [&recording, &stop] { recording->Run(stop); }));
    const std::int64_t end_ns = SteadyNs() + std::llround(1e9 * options.most_seconds);
    // If one camera ends or fails, all end.
    while (!stop && SteadyNs() < end_ns && !AnyEnded(threads)) {
      if (looker.Look(recordings)) {
        stop = listener(looker.Hints());
      } else {
        threads.front().wait_for(kLookInterval);
      }
    }
  }
  for (const auto& thread : threads) thread.wait();
  if (looker.Look(recordings)) listener(looker.Hints());
  for (auto& thread : threads) thread.get();
}

}  // namespace mocap
