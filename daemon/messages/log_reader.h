// Reads LCM logs that may be cut off, damaged, or contain others' messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace mocap {

/// One message of a log.
struct LoggedMessage {
  std::int64_t number = 0;
  std::int64_t utime = 0;  ///< Time of logging, by the logger's clock.
  std::string channel;
  std::vector<std::uint8_t> bytes;
};

/// Reads the events of a log in order.
///
/// LCM's own reader trusts the lengths that it reads and stops at the first wrong one. Here an
/// event is valid if it is complete and does not overlap another. Anything else is skipped and
/// counted, up to the mark of the next event.
class LogReader {
 public:
  /// @throws SetupError  if the file cannot be read.
  explicit LogReader(const std::filesystem::path& file);

  /// Reads the next message; false at the end. Memory of `message` is reused.
  bool Next(LoggedMessage& message);

  /// Bytes and number of the parts skipped so far.
  std::int64_t damaged_bytes() const { return damaged_bytes_; }
  std::int64_t damaged_places() const { return damaged_places_; }

 private:
  bool ReadEvent(std::int64_t place, LoggedMessage& message);
  bool ReadAt(std::int64_t place, void* to, std::size_t bytes);
  bool IsMark(std::int64_t place);
  std::int64_t NextMark(std::int64_t from);

  std::ifstream in_;
  std::int64_t size_ = 0;
  std::int64_t place_ = 0;  ///< Offset of the next event.
  std::int64_t damaged_bytes_ = 0, damaged_places_ = 0;
};

}  // namespace mocap
