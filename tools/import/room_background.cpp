#include "tools/import/room_background.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "core/errors.h"
#include "core/reconstruction/background/change_meter.h"
#include "daemon/service/occupied_room.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/video_writer.h"
#include "tools/import/empty_stretch.h"
#include "tools/import/sampled_pictures.h"
#include "tools/stop_on_signals.h"

namespace mocap {
namespace {

/// Of a clip or stretch: some dozens, as in other takes.
constexpr std::size_t kRoomPictures = 50;
/// Fewer tell nothing about noise.
constexpr std::size_t kFewestRoomPictures = 2;
/// Somebody who walks leaves a place within seconds; shorter videos are sampled more densely.
constexpr std::size_t kFewestSamples = 60;
/// Nobody plays them.
constexpr double kStoredFps = 10;

std::filesystem::path RoomFile(const std::filesystem::path& folder, const std::string& camera) {
  return folder / (camera + ".mkv");
}

/// Stores frames of a video without loss.
/// @param added  gets each picture; may throw.
std::size_t Store(const TimedVideo& video, std::span<const std::size_t> frames,
                  const std::filesystem::path& file,
                  const std::function<void(std::size_t, ImageView<const Bgr>)>& added) {
  std::optional<VideoWriter> writer;
  std::size_t count = 0;
  VisitFrames(video.file, video.times_ns, frames, [&](std::size_t frame, ImageView<const Bgr> p) {
    if (!writer) writer.emplace(file, p.width(), p.height(), kStoredFps, VideoPixels::kBgr);
    writer->Write(p);
    added(frame, p);
    ++count;
    return true;
  });
  if (writer) writer->Finish();
  return count;
}

std::vector<std::size_t> SamplesOf(const TimedVideo& video) {
  const double length_s = video.SecondsOf(video.times_ns.size() - 1);
  const auto wanted = std::max(kFewestSamples, static_cast<std::size_t>(length_s * kOccupiedFps));
  return SpreadFrames(video.times_ns, std::min<std::size_t>(wanted, kMostOccupiedPictures));
}

void RequireRoomPictures(const TimedVideo& video, std::size_t pictures) {
  if (pictures >= kFewestRoomPictures) return;
  throw SetupError(fmt::format("{}: {} has {} that can be decoded; expected at least {}",
                               video.camera, video.file.string(),
                               pictures == 1 ? "1 picture" : "no pictures", kFewestRoomPictures));
}

[[noreturn]] void FailForChange(const TimedVideo& clip, double changed) {
  throw SetupError(
      fmt::format("{}: {:.2g} % of the picture changes in {}; expected a clip without people and "
                  "with fixed exposure, or no --background for this camera",
                  clip.camera, 100 * changed, clip.file.string()));
}

/// Takes the frames of a stretch as the empty room.
RoomRecord TakeStretch(const TimedVideo& video, const EmptyStretch::Stretch& stretch,
                       const std::filesystem::path& folder) {
  std::vector<std::int64_t> times_ns;
  std::size_t first = video.times_ns.size();
  for (std::size_t i = 0; i < video.times_ns.size(); ++i) {
    const double time_s = video.SecondsOf(i);
    if (time_s < stretch.from_s || time_s > stretch.to_s) continue;
    first = std::min(first, i);
    times_ns.push_back(video.times_ns[i]);
  }
  std::vector<std::size_t> frames = SpreadFrames(times_ns, kRoomPictures);
  for (std::size_t& frame : frames) frame += first;
  RoomRecord record{RoomSource::kStretch, 0, stretch.from_s, stretch.to_s, 0, {}};
  record.pictures = Store(video, frames, RoomFile(folder, video.camera), [](auto, auto) {});
  RequireRoomPictures(video, record.pictures);
  return record;
}

/// Learns the empty room from samples in which people move.
RoomRecord LearnBehindPeople(const TimedVideo& video, const std::filesystem::path& samples,
                             const std::filesystem::path& to) {
  const OccupiedRoom room{video.camera, PicturesOf(samples, 1, EndIfStopAsked), std::nullopt};
  try {
    const OccupiedRecord learned = LearnOccupied(room, to);
    return {RoomSource::kItself, learned.pictures, 0, 0, learned.unknown, {}};
  } catch (const SetupError& error) {
    // What it advises is of another command.
    const std::string what = error.what();
    throw SetupError(
        what.substr(0, what.find(';')) +
        "; expected a clip of the empty room (--background), or people who move about");
  }
}

}  // namespace

RoomRecord TakeRoomFromClip(const TimedVideo& clip, const TimedVideo& video,
                            const std::filesystem::path& folder) {
  RoomRecord record{RoomSource::kClip, 0, 0, 0, 0, {}};
  ChangeMeter meter;
  double changed = 0;
  LightMeter light;
  record.pictures =
      Store(clip, SpreadFrames(clip.times_ns, kRoomPictures), RoomFile(folder, clip.camera),
            [&](std::size_t, ImageView<const Bgr> picture) {
              changed = std::max(changed, meter.Measure(picture));
              light.Add(picture);
            });
  RequireRoomPictures(clip, record.pictures);
  if (changed > kMostChange) FailForChange(clip, changed);
  VisitFrames(video.file, video.times_ns, SpreadFrames(video.times_ns, kFewestSamples),
              [&](std::size_t, ImageView<const Bgr> picture) {
                light.Add(picture);
                return true;
              });
  record.light = light.range();
  return record;
}

RoomRecord FindRoomInVideo(const TimedVideo& video, const std::filesystem::path& folder) {
  const std::filesystem::path samples = folder / (video.camera + ".samples.mkv");
  EmptyStretch empty;
  LightMeter light;
  const std::size_t count =
      Store(video, SamplesOf(video), samples, [&](std::size_t frame, ImageView<const Bgr> p) {
        empty.Add(video.SecondsOf(frame), p);
        light.Add(p);
      });
  RequireRoomPictures(video, count);
  RoomRecord record;
  if (const auto stretch = empty.Longest()) {
    record = TakeStretch(video, *stretch, folder);
  } else {
    record = LearnBehindPeople(video, samples, RoomFile(folder, video.camera));
  }
  std::filesystem::remove(samples);
  record.light = light.range();
  return record;
}

}  // namespace mocap
