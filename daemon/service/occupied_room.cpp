#include "daemon/service/occupied_room.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "core/errors.h"
#include "core/reconstruction/empty_room/cleared_pictures.h"
#include "core/reconstruction/empty_room/mean_picture.h"
#include "core/reconstruction/empty_room/stayed_people.h"
#include "core/reconstruction/silhouette/bit_filters.h"
#include "daemon/status/moved_furniture.h"
#include "drivers/nearest_name.h"
#include "drivers/printable_text.h"
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"
#include "drivers/take/mask_video.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/video_reader.h"
#include "drivers/take/video_writer.h"

namespace mocap {
namespace {

using Place = EmptyRoom::Place;

/// Fewer pictures than of fifteen seconds do not tell a wall from somebody who waits.
constexpr std::size_t kFewestPictures = 30;
/// Most that may be unknown, and most that may remain as it is stored [share of the picture].
constexpr double kMostUnknown = 0.1, kMostFilled = 0.5;
/// If more than this share differs from the stored background, the camera was moved.
constexpr double kMostMoved = 0.3;
/// Smaller things are dropped by segmentation, too [share of the picture].
constexpr double kSmallestThing = 0.0005;
/// More than this in one camera are changes of light, or a camera that was touched.
constexpr std::size_t kMostNamed = 3;
constexpr std::size_t kLearnedPictures = 50;
constexpr std::size_t kNoisePictures = 20;
/// Of the stored videos; nobody plays them.
constexpr double kLearnedFps = 10;

/// Visits pictures that were made steady.
void ForEachSteady(
    const OccupiedRoom& room,
    const std::function<void(const Image<Bgr>& picture, const SteadyPicture& steady)>& visit) {
  PictureSteadier steadier;
  room.pictures.ForEach([&](const BackgroundFrame& frame) {
    visit(frame.image, steadier.Steady(frame.image.view()));
  });
}

/// Counts colours over all pictures. @throws SetupError  if there are too few.
ShownColors CountColors(const OccupiedRoom& room) {
  NoiseMeter noise;
  std::size_t count = 0;
  int width = 0, height = 0;
  ForEachSteady(room, [&](const Image<Bgr>& picture, const SteadyPicture& steady) {
    width = picture.width(), height = picture.height();
    if (count++ < kNoisePictures) noise.Add(steady.color.view());
  });
  if (count < kFewestPictures) {
    throw SetupError(fmt::format("{}: has only {} at {:g} a second; expected at least {}",
                                 room.camera, Counted(count, "picture"), kOccupiedFps,
                                 kFewestPictures));
  }
  ShownColors shown(width, height, noise.Tolerance());
  ForEachSteady(room, [&](const Image<Bgr>&, const SteadyPicture& steady) {
    shown.Add(steady.color.view());
  });
  return shown;
}

/// The stored background in the present light, or empty where there is none of that size.
/// @param earlier  gets what it tells.
std::vector<Image<Bgr>> StoredPictures(const OccupiedRoom& room, const ShownColors& shown,
                                       EarlierRoom& earlier) {
  std::vector<Image<Bgr>> stored;
  MeanPicture sum;
  if (!room.stored) return stored;
  const Image<Bgr> present = shown.MostFrequent();
  room.stored->ForEach([&](const BackgroundFrame& frame) {
    const bool fits =
        frame.image.width() == shown.width() && frame.image.height() == shown.height();
    if (!fits || stored.size() == kLearnedPictures) return;
    stored.push_back(InLight(frame.image, LightBetween(Smooth(frame.image.view()), present)));
    sum.Add(stored.back());
    earlier.unseen = frame.unseen;
  });
  if (!stored.empty()) earlier.color = Smooth(sum.Mean().view());
  // Smooth colours beside what is unknown have a part of it.
  if (earlier.unseen.width() != 0) Dilate(Silhouette(earlier.unseen), kSmoothed_px, earlier.unseen);
  return stored;
}

void RequireEnough(const OccupiedRecord& record, double moved) {
  const std::string where = record.camera + ": ";
  if (moved > kMostMoved && !record.is_accepted) {
    throw SetupError(where + ShareText(moved) +
                     " of its picture differs from the stored background; if the camera was turned "
                     "or the room was changed, use --accept " +
                     record.camera);
  }
  if (record.unknown <= kMostUnknown && record.unseen <= kMostFilled) return;
  throw SetupError(where +
                   ShareText(record.unknown > kMostUnknown ? record.unknown : record.unseen) +
                   " of its picture was never seen without people; let them move about everywhere, "
                   "or for longer (--seconds)");
}

void WriteCleared(const OccupiedRoom& of, const EmptyRoom& room, const ShownColors& shown,
                  const std::vector<Image<Bgr>>& stored, const std::filesystem::path& file) {
  ClearedPictures cleared(room, shown.tolerance());
  VideoWriter video(file, shown.width(), shown.height(), kLearnedFps, VideoPixels::kBgr);
  const auto count = static_cast<std::size_t>(shown.pictures());
  const std::size_t wanted = std::min(kLearnedPictures, count);
  ForEachSteady(of, [&](const Image<Bgr>& picture, const SteadyPicture& steady) {
    cleared.Note(picture.view(), steady);
  });
  std::size_t read = 0, written = 0;
  ForEachSteady(of, [&](const Image<Bgr>& picture, const SteadyPicture& steady) {
    const Image<Bgr>* filling = stored.empty() ? nullptr : &stored[written % stored.size()];
    const Image<Bgr>& empty = cleared.Clear(picture.view(), steady, filling);
    if (read++ * wanted / count < written || written == wanted) return;
    video.Write(empty.view());
    ++written;
  });
  video.Finish();
}

/// What neither the pictures nor the stored background show empty.
Silhouette UnknownOf(const EmptyRoom& room, const EarlierRoom* earlier) {
  Silhouette unknown(room.color.width(), room.color.height());
  for (int y = 0; y < unknown.height(); ++y) {
    for (int x = 0; x < unknown.width(); ++x) {
      const Place place = room.places[static_cast<std::size_t>(y) * unknown.width() + x];
      if (place == Place::kUnseen && !(earlier && earlier->Knows(x, y))) unknown.Set(x, y);
    }
  }
  return unknown;
}

}  // namespace

OccupiedRecord LearnOccupied(const OccupiedRoom& of, const std::filesystem::path& video) {
  const ShownColors shown = CountColors(of);
  std::optional<EarlierRoom> earlier(std::in_place);
  std::vector<Image<Bgr>> stored = StoredPictures(of, shown, *earlier);
  if (stored.empty()) earlier.reset();
  EmptyRoom room = FindEmptyRoom(shown, earlier ? &*earlier : nullptr);
  OccupiedRecord record{of.camera, shown.width(), shown.height(),
                        static_cast<std::size_t>(shown.pictures())};
  const int smallest_px =
      static_cast<int>(kSmallestThing * static_cast<double>(room.places.size()));
  record.is_accepted = of.is_accepted;
  record.moved = FindMoved(room, smallest_px);
  const double moved = room.ShareOf(Place::kMoved);
  if (moved > kMostMoved && of.is_accepted) {
    // What shows another view tells nothing of this one.
    stored.clear(), earlier.reset();
    room = FindEmptyRoom(shown, nullptr);
  }
  HideStayedPeople(earlier ? &*earlier : nullptr, smallest_px, room);
  record.unseen = room.ShareOf(Place::kUnseen);
  record.is_filled = earlier.has_value();
  if (!of.is_accepted) room.ForgetMoved();
  const Silhouette unknown = UnknownOf(room, earlier ? &*earlier : nullptr);
  record.unknown = unknown.CoveredShare();
  RequireEnough(record, moved);
  WriteCleared(of, room, shown, stored, video);
  if (unknown.BoundingBox()) WriteMask(UnseenBeside(video), unknown);
  return record;
}

OccupiedRecord LearnInPlace(const OccupiedRoom& room, const std::filesystem::path& folder) {
  // A camera's name has no dot.
  const std::filesystem::path learned = folder / (room.camera + ".learned.mkv");
  const std::filesystem::path here = folder / (room.camera + ".mkv");
  const OccupiedRecord record = LearnOccupied(room, learned);
  std::filesystem::rename(learned, here);
  if (IsThere(UnseenBeside(learned)))
    std::filesystem::rename(UnseenBeside(learned), UnseenBeside(here));
  return record;
}

BackgroundSource PicturesOf(const std::filesystem::path& file, int step,
                            std::function<void()> check) {
  return BackgroundSource::OneByOne([file, step, check](const BackgroundSource::Visit& visit) {
    VideoReader video(file);
    BackgroundFrame frame{Image<Bgr>(video.width_px(), video.height_px()), {}};
    if (IsThere(UnseenBeside(file))) frame.unseen = ReadMask(UnseenBeside(file));
    ImageView<const Bgr> view;
    for (int i = 0;; ++i) {
      check();
      const VideoStatus status = i % step == 0 ? video.Read(view) : video.Skip();
      if (status == VideoStatus::kEnd) return;
      if (i % step != 0 || status == VideoStatus::kBroken) continue;
      for (int y = 0; y < view.height(); ++y)
        std::copy_n(view.row(y), view.width(), frame.image.row(y));
      visit(frame);
    }
  });
}

void RequireAccepted(const std::vector<std::string>& accepted,
                     const std::vector<std::string>& cameras) {
  for (const std::string& name : accepted) {
    if (std::ranges::find(cameras, name) != cameras.end()) continue;
    throw SetupError("--accept: there is no camera " + Quoted(name) + "; " +
                     ExpectedNames(name, cameras));
  }
}

std::vector<std::string> TextOf(const OccupiedRecord& record) {
  std::string filling = record.unseen == 0 ? ""
                        : record.is_filled ? "; the stored background remains there"
                                           : "; it is unknown";
  if (record.is_filled && record.unknown > 0)
    filling += fmt::format(", and {} of the picture is unknown", ShareText(record.unknown));
  std::vector<std::string> lines = {
      fmt::format("{}: {}, {} of its picture was never seen without people{}", record.camera,
                  Counted(record.pictures, "picture"), ShareText(record.unseen), filling)};
  const double pixels = static_cast<double>(record.width_px) * record.height_px;
  for (std::size_t i = 0; i < std::min(record.moved.size(), kMostNamed); ++i) {
    const MovedThing& thing = record.moved[i];
    lines.push_back(fmt::format(
        "{}: something was moved at the {} ({} of the picture); {}", record.camera,
        PlaceInPicture(thing.box, record.width_px, record.height_px),
        ShareText(thing.area_px / pixels),
        record.is_accepted
            ? "it is part of the background now"
            : fmt::format("the stored background remains there, unless you use --accept {}",
                          record.camera)));
  }
  if (record.moved.size() > kMostNamed) {
    lines.push_back(fmt::format("{}: likewise at {}", record.camera,
                                Counted(record.moved.size() - kMostNamed, "smaller place")));
  }
  return lines;
}

}  // namespace mocap
