#include "tools/import/synchronize.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "tools/import/motion_offsets.h"
#include "tools/import/sound_offsets.h"

namespace mocap {
namespace {

constexpr double kDay_s = 86400;
/// A timecode counts whole frames.
constexpr double kFramesOfTimecode = 0.5;
/// Where sound and timecode differ by more frames, one of them is wrong.
constexpr double kFramesOfSound = 1.5;
/// What agrees less clearly may be by chance, such as steps of a walker.
constexpr double kLeastClearMotion = 1.2;
/// An offset that is less clear is worth a remark: in little motion, a wrong one may be so clear.
constexpr double kDoubtfulMotion = 2;
/// Agreement of pairs that is worth a remark: a quarter of a frame at 30 Hz.
constexpr double kDoubtful_s = 0.009;

std::vector<ClockFit> FitsOf(const std::vector<CameraClock>& clocks) {
  std::vector<ClockFit> fits;
  for (const CameraClock& clock : clocks) fits.push_back(clock.fit);
  return fits;
}

double FirstOf(const SyncVideo& video) {
  return static_cast<double>(video.index->times_ns.front()) / 1e9;
}

double LastOf(const SyncVideo& video) {
  return static_cast<double>(video.index->times_ns.back()) / 1e9;
}

void Know(double offset_s, double sigma_s, SyncMethod method, CameraClock& clock) {
  clock.method = method;
  clock.fit = {offset_s, 0, sigma_s, 0, 1, true};
}

bool IsWanted(const SyncRequest& request, SyncMethod method) {
  return !request.method || *request.method == method;
}

void UseGiven(std::span<const SyncVideo> videos, const SyncRequest& request,
              std::vector<CameraClock>& clocks) {
  for (std::size_t i = 0; i < videos.size(); ++i) {
    const auto given = request.given_s.find(videos[i].camera);
    if (given != request.given_s.end())
      Know(given->second, 0, SyncMethod::kGiven, clocks[i]);
    else if (request.method == SyncMethod::kGiven)
      throw SetupError("--sync given: --offsets has no " + videos[i].camera +
                       "; expected the offset of every camera");
  }
}

/// Offset by which a video's own times become a clock's; empty: it does not tell.
using Telling = std::optional<double>;

Telling ByTimecode(const SyncVideo& video) {
  if (video.index->timecode.empty()) return std::nullopt;
  const auto time_ns = TimeOfTimecode(video.index->timecode, UsualRateHz(video.index->times_ns));
  if (!time_ns) return std::nullopt;
  return static_cast<double>(*time_ns) / 1e9 - FirstOf(video);
}

Telling ByClock(const SyncVideo& video) {
  const auto created = CreationTimeFromText(video.index->created);
  if (!created || created->is_whole_second) return std::nullopt;
  // Nanoseconds of a day: the whole number would leave a double no microseconds.
  constexpr std::int64_t kDay_ns = 86'400'000'000'000;
  return static_cast<double>(created->epoch_ns % kDay_ns) / 1e9 - FirstOf(video);
}

/// Whether all recordings have a moment in common by these offsets.
bool HaveCommonTime(std::span<const SyncVideo> videos, const std::vector<Telling>& offsets) {
  double first_s = -1e300, last_s = 1e300;
  for (std::size_t i = 0; i < videos.size(); ++i) {
    if (!offsets[i]) continue;
    first_s = std::max(first_s, FirstOf(videos[i]) + *offsets[i]);
    last_s = std::min(last_s, LastOf(videos[i]) + *offsets[i]);
  }
  return first_s < last_s;
}

std::vector<Telling> AllTold(std::span<const SyncVideo> videos, Telling (*tell)(const SyncVideo&)) {
  std::vector<Telling> told;
  for (const SyncVideo& video : videos) told.push_back(tell(video));
  // Midnight may have come between.
  for (Telling& offset : told) {
    if (offset && told[0] && *offset - *told[0] > kDay_s / 2) *offset -= kDay_s;
    if (offset && told[0] && *told[0] - *offset > kDay_s / 2) *offset += kDay_s;
  }
  return told;
}

void RequireAll(std::span<const SyncVideo> videos, const std::vector<Telling>& told,
                const std::string& method, const std::string& what) {
  std::vector<std::string> without;
  for (std::size_t i = 0; i < videos.size(); ++i)
    if (!told[i]) without.push_back(videos[i].camera);
  if (!without.empty())
    throw SetupError("--sync " + method + ": " + ListedNames(without) + ": the file has " + what +
                     "; expected one in all videos, or --sync auto");
  if (!HaveCommonTime(videos, told))
    throw SetupError("--sync " + method +
                     ": the recordings have no moment in common; expected clocks that were set to "
                     "the same time");
}

std::size_t CountTold(const std::vector<Telling>& told) {
  return static_cast<std::size_t>(
      std::ranges::count_if(told, [](const Telling& offset) { return offset.has_value(); }));
}

/// Cameras that count from the start of each recording have the same timecode.
bool CountsFromStart(std::span<const SyncVideo> videos) {
  return std::ranges::all_of(videos, [&](const SyncVideo& video) {
    return video.index->timecode == videos[0].index->timecode;
  });
}

void UseTimecode(std::span<const SyncVideo> videos, const SyncRequest& request,
                 std::vector<std::string>& remarks, std::vector<CameraClock>& clocks) {
  if (!IsWanted(request, SyncMethod::kTimecode)) return;
  const std::vector<Telling> told = AllTold(videos, ByTimecode);
  if (request.method) RequireAll(videos, told, "timecode", "no timecode");
  if (CountTold(told) < 2) return;
  const bool is_usable = HaveCommonTime(videos, told) && !CountsFromStart(videos);
  if (!request.method && !is_usable) {
    remarks.push_back("the timecodes of the files are of no common clock, and are not used");
    return;
  }
  for (std::size_t i = 0; i < videos.size(); ++i) {
    if (!told[i] || clocks[i].fit.is_known) continue;
    const double frame_s = 1 / UsualRateHz(videos[i].index->times_ns);
    Know(*told[i], kFramesOfTimecode * frame_s, SyncMethod::kTimecode, clocks[i]);
  }
}

std::vector<std::optional<SoundTrack>> ReadSounds(std::span<const SyncVideo> videos,
                                                  const std::function<void()>& check) {
  std::vector<std::optional<SoundTrack>> sounds;
  for (const SyncVideo& video : videos) {
    sounds.emplace_back();
    if (video.index->has_sound) sounds.back() = ReadSound(video.file, check);
  }
  return sounds;
}

void RequireSounds(std::span<const SyncVideo> videos,
                   const std::vector<std::optional<SoundTrack>>& sounds) {
  std::vector<std::string> without;
  for (std::size_t i = 0; i < videos.size(); ++i)
    if (!sounds[i]) without.push_back(videos[i].camera);
  if (!without.empty())
    throw SetupError("--sync sound: " + ListedNames(without) +
                     ": the file has no sound; expected sound in all videos, or --sync auto");
}

/// Forgets timecodes that sound contradicts. Where it agrees, it is more exact.
void CheckTimecodes(std::span<const SyncVideo> videos, const std::vector<ClockFit>& heard,
                    std::vector<std::string>& remarks, std::vector<CameraClock>& clocks) {
  int anchor = -1;
  for (std::size_t i = 0; i < clocks.size(); ++i) {
    if (clocks[i].method != SyncMethod::kTimecode || !heard[i].is_known) continue;
    if (anchor < 0) anchor = static_cast<int>(i);
    const double shift_s = clocks[anchor].fit.offset_s - heard[anchor].offset_s;
    const double apart_s = heard[i].offset_s + shift_s - clocks[i].fit.offset_s;
    if (std::abs(apart_s) * UsualRateHz(videos[i].index->times_ns) <= kFramesOfSound) continue;
    remarks.push_back(
        fmt::format("{}: its timecode is {:.3f} s off by the sound; the timecodes are not used",
                    videos[i].camera, apart_s));
    for (CameraClock& clock : clocks)
      if (clock.method == SyncMethod::kTimecode) clock = {};
    return;
  }
}

/// Offsets by what recordings heard, as if all sounds came from the middle of the room.
std::vector<PairOffset> HeardOffsets(std::span<const SyncVideo> videos,
                                     const std::vector<std::optional<SoundTrack>>& sounds,
                                     const std::function<void()>& check) {
  std::vector<PairOffset> pairs = SoundOffsets(sounds, check);
  for (PairOffset& pair : pairs)
    pair.ahead_s -=
        videos[pair.first].travel.from_middle_s - videos[pair.second].travel.from_middle_s;
  return pairs;
}

void UseSound(std::span<const SyncVideo> videos, const SyncRequest& request,
              std::vector<std::string>& remarks, const std::function<void()>& check,
              std::vector<CameraClock>& clocks) {
  if (!IsWanted(request, SyncMethod::kSound)) return;
  const auto sounds = ReadSounds(videos, check);
  if (request.method) RequireSounds(videos, sounds);
  const std::vector<PairOffset> pairs = HeardOffsets(videos, sounds, check);
  if (pairs.empty()) return;
  CheckTimecodes(videos, FitClocks(std::vector<ClockFit>(videos.size()), pairs), remarks, clocks);
  std::vector<ClockFit> known = FitsOf(clocks);
  for (std::size_t i = 0; i < clocks.size(); ++i)
    if (clocks[i].method == SyncMethod::kTimecode) known[i] = {};
  const std::vector<ClockFit> fits = FitClocks(known, pairs);
  // The clock of timecodes goes on where sound tells nothing.
  double shift_s = 0;
  for (std::size_t i = 0; i < clocks.size(); ++i) {
    if (clocks[i].method == SyncMethod::kTimecode && fits[i].is_known)
      shift_s = clocks[i].fit.offset_s - fits[i].offset_s;
  }
  for (std::size_t i = 0; i < clocks.size(); ++i) {
    const bool is_told = std::ranges::any_of(pairs, [&](const PairOffset& pair) {
      return pair.first == static_cast<int>(i) || pair.second == static_cast<int>(i);
    });
    if (!fits[i].is_known || !is_told || clocks[i].method == SyncMethod::kGiven) continue;
    clocks[i] = {SyncMethod::kSound, fits[i]};
    clocks[i].fit.offset_s += shift_s;
    clocks[i].fit.sigma_s = std::hypot(fits[i].sigma_s, videos[i].travel.sigma_s);
    if (fits[i].worst_s > kDoubtful_s)
      remarks.push_back(
          fmt::format("{}: what it hears is up to {:.0f} ms from what others hear at the same "
                      "time; sound needs 3 ms for a metre",
                      videos[i].camera, 1000 * fits[i].worst_s));
  }
}

void UseClocks(std::span<const SyncVideo> videos, std::vector<CameraClock>& clocks) {
  const std::vector<Telling> told = AllTold(videos, ByClock);
  RequireAll(videos, told, "clock", "no time of day with parts of a second");
  for (std::size_t i = 0; i < videos.size(); ++i)
    if (!clocks[i].fit.is_known) Know(*told[i], 0.5, SyncMethod::kClock, clocks[i]);
}

[[noreturn]] void FailToSync(std::span<const SyncVideo> videos,
                             const std::vector<CameraClock>& clocks, const std::string& why) {
  std::vector<std::string> lost;
  for (std::size_t i = 0; i < clocks.size(); ++i)
    if (!clocks[i].fit.is_known) lost.push_back(videos[i].camera);
  throw SetupError(ListedNames(lost) + ": " + why + "; give offsets, such as --offsets " +
                   lost.front() + "=1.25");
}

/// Clearness of the least clear camera that is to be found; 0: one is not found.
double ClearnessOf(const std::vector<ClockFit>& fits, const std::vector<CameraClock>& clocks) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (!clocks[i].fit.is_known) least = std::min(least, fits[i].is_known ? fits[i].clearness : 0);
  }
  return least;
}

/// Compares everybody; or, where that is not clear, whoever is the largest in each picture.
std::vector<ClockFit> FitMotion(const MotionSeen& seen, const std::vector<CameraClock>& clocks,
                                const std::function<void()>& check) {
  std::vector<ClockFit> everybody = ClocksByMotion(seen.everybody, FitsOf(clocks), check);
  if (ClearnessOf(everybody, clocks) >= kLeastClearMotion) return everybody;
  std::vector<ClockFit> largest = ClocksByMotion(seen.largest, FitsOf(clocks), check);
  return ClearnessOf(largest, clocks) > ClearnessOf(everybody, clocks) ? largest : everybody;
}

std::string WhyNotClear(const std::vector<CameraClock>& clocks, const std::vector<ClockFit>& fits) {
  double most = 0;
  for (std::size_t i = 0; i < clocks.size(); ++i)
    if (!clocks[i].fit.is_known && fits[i].is_known) most = std::max(most, fits[i].clearness);
  const std::string why = "the silhouettes agree with those of the others at no offset clearly";
  if (most == 0) return why;
  return why + fmt::format(" (at the best {:.2f} times as well as at another; expected {:g} times)",
                           most, kLeastClearMotion);
}

}  // namespace

std::vector<CameraClock> SyncByFiles(std::span<const SyncVideo> videos, const SyncRequest& request,
                                     std::vector<std::string>& remarks,
                                     const std::function<void()>& check) {
  std::vector<CameraClock> clocks(videos.size());
  UseGiven(videos, request, clocks);
  if (NeedsMotion(clocks)) UseTimecode(videos, request, remarks, clocks);
  const bool lacks_sound = std::ranges::any_of(clocks, [](const CameraClock& clock) {
    return clock.method == SyncMethod::kNone || clock.method == SyncMethod::kTimecode;
  });
  if (lacks_sound) UseSound(videos, request, remarks, check, clocks);
  if (request.method == SyncMethod::kClock) UseClocks(videos, clocks);
  if (request.method && request.method != SyncMethod::kMotion && NeedsMotion(clocks))
    FailToSync(videos, clocks, "heard nothing that the others heard as well");
  return clocks;
}

bool NeedsMotion(const std::vector<CameraClock>& clocks) {
  return !std::ranges::all_of(clocks, [](const CameraClock& clock) { return clock.fit.is_known; });
}

void SyncByMotion(std::span<const SyncVideo> videos, const MotionSeen& seen,
                  const SyncRequest& request, std::vector<std::string>& remarks,
                  const std::function<void()>& check, std::vector<CameraClock>& clocks) {
  const std::vector<ClockFit> fits = FitMotion(seen, clocks, check);
  const bool all_move = std::ranges::all_of(
      fits, [](const ClockFit& fit) { return fit.is_known && fit.clearness >= kLeastClearMotion; });
  const bool nothing_else =
      std::ranges::none_of(clocks, [](const CameraClock& clock) { return clock.fit.is_known; });
  if (!all_move && nothing_else && !request.method &&
      CountTold(AllTold(videos, ByClock)) == videos.size()) {
    remarks.push_back(
        "neither sound nor motion tells the offsets; the clocks in the files are used, "
        "which may be wrong by tenths of a second");
    return UseClocks(videos, clocks);
  }
  for (std::size_t i = 0; i < clocks.size(); ++i) {
    if (clocks[i].fit.is_known || !fits[i].is_known) continue;
    if (fits[i].clearness < kLeastClearMotion) continue;
    clocks[i] = {SyncMethod::kMotion, fits[i]};
    if (fits[i].sigma_s > kDoubtful_s)
      remarks.push_back(fmt::format("{}: its silhouettes tell its offset to {:.0f} ms only",
                                    videos[i].camera, 1000 * fits[i].sigma_s));
    if (fits[i].clearness < kDoubtfulMotion)
      remarks.push_back(
          fmt::format("{}: its silhouettes agree with those of the others only {:.1f} times as "
                      "well as at another offset; check it, or give --offsets",
                      videos[i].camera, fits[i].clearness));
  }
  if (NeedsMotion(clocks)) FailToSync(videos, clocks, WhyNotClear(clocks, fits));
}

}  // namespace mocap
