#include "tools/occupied_room.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "core/errors.h"
#include "core/reconstruction/empty_room/cleared_pictures.h"
#include "drivers/printable_text.h"
#include "drivers/take/video_writer.h"

namespace mocap {
namespace {

using Place = EmptyRoom::Place;

/// Fewer pictures than of fifteen seconds do not tell a wall from somebody who waits.
constexpr std::size_t kFewestPictures = 30;
/// Most that may be unknown: without a background until now, and with one [share of the picture].
constexpr double kMostUnseen = 0.01, kMostFilled = 0.5;
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

/// The mean of pictures.
class MeanPicture {
 public:
  void Add(const Image<Bgr>& picture) {
    sums_.resize(picture.pixels().size());
    size_ = {picture.width(), picture.height()};
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const Bgr& pixel = picture.pixels()[i];
      sums_[i][0] += pixel.b, sums_[i][1] += pixel.g, sums_[i][2] += pixel.r;
    }
    ++count_;
  }

  Image<Bgr> Mean() const {
    Image<Bgr> mean(size_.first, size_.second);
    const auto of = [this](std::uint32_t sum) {
      return static_cast<std::uint8_t>((sum + count_ / 2) / count_);
    };
    for (std::size_t i = 0; i < sums_.size(); ++i)
      mean.pixels()[i] = {of(sums_[i][0]), of(sums_[i][1]), of(sums_[i][2])};
    return mean;
  }

 private:
  std::vector<std::array<std::uint32_t, 3>> sums_;
  std::pair<int, int> size_;
  std::uint32_t count_ = 0;
};

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
/// @param mean  gets their mean, smooth.
std::vector<Image<Bgr>> StoredPictures(const OccupiedRoom& room, const ShownColors& shown,
                                       Image<Bgr>& mean) {
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
  });
  if (!stored.empty()) mean = Smooth(sum.Mean().view());
  return stored;
}

std::string Percent(double share) {
  return share < 0.1 ? fmt::format("{:.2g} %", 100 * share) : fmt::format("{:.0f} %", 100 * share);
}

void RequireEnough(const OccupiedRecord& record, double moved) {
  const std::string where = record.camera + ": ";
  if (moved > kMostMoved && !record.is_accepted) {
    throw SetupError(where + Percent(moved) +
                     " of its picture differs from the stored background; if the camera was turned "
                     "or the room was changed, use --accept " +
                     record.camera);
  }
  if (record.unseen <= (record.is_filled ? kMostFilled : kMostUnseen)) return;
  throw SetupError(where + Percent(record.unseen) +
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

/// Where in the picture something is.
std::string PlaceOf(const OccupiedRecord& record, const PixelBox& box) {
  constexpr const char* kRows[] = {"top", "middle", "bottom"};
  constexpr const char* kColumns[] = {"left", "middle", "right"};
  const int row = std::min(3 * (box.top + box.bottom) / 2 / record.height_px, 2);
  const int column = std::min(3 * (box.left + box.right) / 2 / record.width_px, 2);
  const std::string words =
      row == 1 && column == 1 ? "middle" : fmt::format("{} {}", kRows[row], kColumns[column]);
  return fmt::format("{}, x {} to {}, y {} to {} px", words, box.left, box.right, box.top,
                     box.bottom);
}

}  // namespace

OccupiedRecord LearnOccupied(const OccupiedRoom& of, const std::filesystem::path& video) {
  const ShownColors shown = CountColors(of);
  Image<Bgr> mean;
  std::vector<Image<Bgr>> stored = StoredPictures(of, shown, mean);
  EmptyRoom room = FindEmptyRoom(shown, stored.empty() ? nullptr : &mean);
  OccupiedRecord record{of.camera, shown.width(), shown.height(),
                        static_cast<std::size_t>(shown.pictures())};
  record.is_accepted = of.is_accepted;
  record.moved =
      FindMoved(room, static_cast<int>(kSmallestThing * static_cast<double>(room.places.size())));
  const double moved = room.ShareOf(Place::kMoved);
  if (moved > kMostMoved && of.is_accepted) {
    // What shows another view tells nothing of this one.
    stored.clear();
    room = FindEmptyRoom(shown, nullptr);
  }
  record.unseen = room.ShareOf(Place::kUnseen);
  record.is_filled = !stored.empty();
  RequireEnough(record, moved);
  if (!of.is_accepted) room.ForgetMoved();
  WriteCleared(of, room, shown, stored, video);
  return record;
}

std::vector<std::string> TextOf(const OccupiedRecord& record) {
  const char* const filling = record.unseen == 0 ? ""
                              : record.is_filled ? "; the stored background remains there"
                                                 : "; what is beside it was taken for it";
  std::vector<std::string> lines = {
      fmt::format("{}: {}, {} of its picture was never seen without people{}", record.camera,
                  Counted(record.pictures, "picture"), Percent(record.unseen), filling)};
  const double pixels = static_cast<double>(record.width_px) * record.height_px;
  for (std::size_t i = 0; i < std::min(record.moved.size(), kMostNamed); ++i) {
    const MovedThing& thing = record.moved[i];
    lines.push_back(fmt::format(
        "{}: something was moved at the {} ({} of the picture); {}", record.camera,
        PlaceOf(record, thing.box), Percent(thing.area_px / pixels),
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
