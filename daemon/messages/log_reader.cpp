#include "daemon/messages/log_reader.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/errors.h"
#include "drivers/take/input_file.h"

namespace mocap {
namespace {

/// Mark, number, time, lengths of channel and data; all big-endian.
constexpr std::int64_t kHead = 28;
constexpr std::array<char, 4> kMark = {'\xed', '\xa1', '\xda', '\x01'};
constexpr std::int64_t kLongestChannel = 255;
constexpr std::size_t kChunk = 1 << 16;

template <typename Number>
Number NumberIn(const std::array<std::uint8_t, kHead>& head, std::size_t at) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < sizeof(Number); ++i) number = number << 8 | head[at + i];
  return static_cast<Number>(number);
}

}  // namespace

LogReader::LogReader(const std::filesystem::path& file) {
  RequireFile(file, "an LCM log");
  in_.open(file, std::ios::binary | std::ios::ate);
  if (!in_) throw SetupError(file.string() + ": cannot be read; expected an LCM log");
  size_ = in_.tellg();
}

bool LogReader::ReadAt(std::int64_t place, void* to, std::size_t bytes) {
  if (place > size_ - static_cast<std::int64_t>(bytes)) return false;
  in_.clear();
  // An unneeded seek would discard the read-ahead buffer.
  if (in_.tellg() != place) in_.seekg(place);
  return static_cast<bool>(in_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes)));
}

bool LogReader::IsMark(std::int64_t place) {
  std::array<char, 4> found{};
  return ReadAt(place, found.data(), found.size()) && found == kMark;
}

std::int64_t LogReader::NextMark(std::int64_t from) {
  std::string chunk;
  const std::string_view mark(kMark.data(), kMark.size());
  for (std::int64_t place = from; place < size_; place += kChunk) {
    // A mark may cross the end of a chunk.
    const auto bytes =
        std::min<std::int64_t>(size_ - place, static_cast<std::int64_t>(kChunk + mark.size() - 1));
    chunk.resize(static_cast<std::size_t>(bytes));
    if (!ReadAt(place, chunk.data(), chunk.size())) return size_;
    const std::size_t found = chunk.find(mark);
    if (found != std::string::npos) return place + static_cast<std::int64_t>(found);
  }
  return size_;
}

bool LogReader::ReadEvent(std::int64_t place, LoggedMessage& message) {
  std::array<std::uint8_t, kHead> head{};
  if (!IsMark(place) || !ReadAt(place, head.data(), head.size())) return false;
  message.number = NumberIn<std::int64_t>(head, 4);
  message.utime = NumberIn<std::int64_t>(head, 12);
  const auto channel = NumberIn<std::int32_t>(head, 20);
  const auto data = NumberIn<std::int32_t>(head, 24);
  const std::int64_t rest = size_ - place - kHead;
  if (channel <= 0 || channel > kLongestChannel || data < 0 || channel > rest - data) return false;
  const std::int64_t end = place + kHead + channel + data;
  // If no event follows, and this one overlaps another, its lengths are wrong.
  if (end != size_ && !IsMark(end) && NextMark(place + 1) < end) return false;
  message.channel.resize(static_cast<std::size_t>(channel));
  message.bytes.resize(static_cast<std::size_t>(data));
  if (!ReadAt(place + kHead, message.channel.data(), message.channel.size())) return false;
  if (!message.bytes.empty() &&
      !ReadAt(place + kHead + channel, message.bytes.data(), message.bytes.size())) {
    return false;
  }
  place_ = end;
  return true;
}

bool LogReader::Next(LoggedMessage& message) {
  bool is_damaged = false;
  while (place_ < size_) {
    if (ReadEvent(place_, message)) return true;
    const std::int64_t next = NextMark(place_ + 1);
    damaged_bytes_ += next - place_;
    damaged_places_ += is_damaged ? 0 : 1;
    is_damaged = true;
    place_ = next;
  }
  return false;
}

}  // namespace mocap
