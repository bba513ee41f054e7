#include "drivers/take/video_index.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "core/errors.h"
#include "core/quantile.h"
#include "drivers/take/libav.h"
#include "drivers/take/take_table.h"
#include "drivers/utc_time.h"

extern "C" {
#include <libavutil/timecode.h>
}

namespace mocap {
namespace {

constexpr AVRational kNanoseconds = {1, 1'000'000'000};
constexpr std::int64_t kSecond_ns = 1'000'000'000;
/// Far beyond any recording, but without overflow in sums.
constexpr std::int64_t kLatestTime_ns = 3'000'000'000'000'000'000;
/// Intervals of so many usual ones have a picture missing. Others are rounded, to milliseconds in
/// Matroska, which their mean is not.
constexpr double kGap = 1.5;
/// Two pictures of one time are told apart by this.
constexpr std::int64_t kLeastApart_ns = 1000;

std::string TagOf(const AVDictionary* tags, const char* name) {
  const AVDictionaryEntry* entry = av_dict_get(tags, name, nullptr, 0);
  return entry == nullptr ? std::string() : entry->value;
}

/// A tag of the file or else of one of its streams.
std::string TagOf(const AVFormatContext& input, const char* name) {
  std::string value = TagOf(input.metadata, name);
  for (unsigned i = 0; value.empty() && i < input.nb_streams; ++i)
    value = TagOf(input.streams[i]->metadata, name);
  return value;
}

/// The times of all packets of a stream, as they are stored.
std::vector<std::int64_t> StoredTimes(const std::filesystem::path& file, AVFormatContext& input,
                                      int stream, const std::function<void()>& check) {
  const PacketPtr packet(av_packet_alloc());
  MOCAP_CHECK(packet);
  std::vector<std::int64_t> times_ns;
  while (av_read_frame(&input, packet.get()) >= 0) {
    check();
    if (packet->stream_index == stream && packet->pts != AV_NOPTS_VALUE)
      times_ns.push_back(av_rescale_q(packet->pts, input.streams[stream]->time_base, kNanoseconds));
    else if (packet->stream_index == stream)
      throw SetupError(
          file.string() +
          ": does not say when its pictures were taken; expected MP4, MOV or Matroska");
    av_packet_unref(packet.get());
    if (times_ns.size() > kMostVideoFrames)
      throw SetupError(file.string() + ": has more than " + std::to_string(kMostVideoFrames) +
                       " pictures; expected a shorter video");
  }
  return times_ns;
}

/// @param times_ns  ascending, of any size.
void RequireTimes(const std::filesystem::path& file, const std::vector<std::int64_t>& times_ns) {
  const bool are_far = times_ns.front() < -kLatestTime_ns || times_ns.back() > kLatestTime_ns ||
                       times_ns.back() - times_ns.front() > kLongestTake_ns;
  if (are_far)
    throw SetupError(file.string() +
                     ": its pictures lie more than a week apart; expected a shorter video");
}

}  // namespace

VideoIndex ReadVideoIndex(const std::filesystem::path& file, const std::function<void()>& check) {
  av_log_set_level(AV_LOG_QUIET);
  const InputPtr input = OpenInput(file);
  if (avformat_find_stream_info(input.get(), nullptr) < 0)
    throw SetupError(file.string() + ": is damaged");
  const int stream = av_find_best_stream(input.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  if (stream < 0)
    throw SetupError(file.string() + ": has no video that FFmpeg decodes; expected a video file");
  VideoIndex index;
  index.has_sound = av_find_best_stream(input.get(), AVMEDIA_TYPE_AUDIO, -1, -1, nullptr, 0) >= 0;
  index.timecode = TagOf(*input, "timecode");
  // Apple's own tag has the time zone, and survives editing.
  index.created = TagOf(*input, "com.apple.quicktime.creationdate");
  if (index.created.empty()) index.created = TagOf(*input, "creation_time");
  index.times_ns = StoredTimes(file, *input, stream, check);
  if (index.times_ns.empty())
    throw SetupError(file.string() + ": contains no complete frame; expected at least one");
  std::ranges::sort(index.times_ns);
  RequireTimes(file, index.times_ns);
  for (std::size_t i = 1; i < index.times_ns.size(); ++i)
    index.times_ns[i] = std::max(index.times_ns[i], index.times_ns[i - 1] + kLeastApart_ns);
  return index;
}

double UsualRateHz(std::span<const std::int64_t> times_ns) {
  std::vector<double> intervals_s;
  for (std::size_t i = 1; i < times_ns.size(); ++i)
    intervals_s.push_back(static_cast<double>(times_ns[i] - times_ns[i - 1]) / 1e9);
  if (intervals_s.empty()) return 0;
  const double longest_s = kGap * MedianOf(intervals_s);
  double sum_s = 0;
  std::size_t count = 0;
  for (const double interval_s : intervals_s)
    if (interval_s < longest_s) sum_s += interval_s, ++count;
  return static_cast<double>(count) / sum_s;
}

std::optional<std::int64_t> TimeOfTimecode(const std::string& timecode, double frames_hz) {
  if (!(frames_hz > 0.5 && frames_hz < 1000)) return std::nullopt;
  const auto counted = static_cast<int>(std::lround(frames_hz));
  const double ntsc_hz = counted * 1000.0 / 1001;
  const bool is_ntsc = std::abs(frames_hz - ntsc_hz) < std::abs(frames_hz - counted);
  const AVRational rate = is_ntsc ? AVRational{counted * 1000, 1001} : AVRational{counted, 1};
  AVTimecode parsed{};
  if (av_timecode_init_from_string(&parsed, rate, timecode.c_str(), nullptr) < 0)
    return std::nullopt;
  return std::llround(parsed.start / av_q2d(rate) * static_cast<double>(kSecond_ns));
}

std::optional<CreationTime> CreationTimeFromText(const std::string& text) {
  constexpr std::size_t kToSeconds = std::string_view("2026-11-21T20:05:00").size();
  if (text.size() < kToSeconds) return std::nullopt;
  const std::optional<std::int64_t> whole_s = UtcFromText(text.substr(0, kToSeconds) + 'Z');
  if (!whole_s || std::abs(*whole_s) > kLatestTime_ns / kSecond_ns) return std::nullopt;
  CreationTime time{*whole_s * kSecond_ns, true};
  std::size_t at = kToSeconds;
  if (at < text.size() && text[at] == '.') {
    std::int64_t unit_ns = kSecond_ns / 10;
    for (++at; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at, unit_ns /= 10)
      time.epoch_ns += (text[at] - '0') * unit_ns;
    // Whole seconds are written with a fraction of zeros.
    time.is_whole_second = time.epoch_ns % kSecond_ns == 0;
  }
  const std::string zone = text.substr(at);
  if (zone.empty() || zone == "Z") return time;
  int hours = 0, minutes = 0;
  const std::string_view digits = std::string_view(zone).substr(1);
  const bool is_zone =
      (zone[0] == '+' || zone[0] == '-') &&
      (std::sscanf(zone.c_str() + 1, "%2d:%2d", &hours, &minutes) == 2 ||
       (digits.size() == 4 && std::sscanf(zone.c_str() + 1, "%2d%2d", &hours, &minutes) == 2));
  if (!is_zone) return std::nullopt;
  const std::int64_t ahead_s = (hours * 60 + minutes) * 60;
  time.epoch_ns -= (zone[0] == '-' ? -ahead_s : ahead_s) * kSecond_ns;
  return time;
}

}  // namespace mocap
