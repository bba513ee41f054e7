// An LCM log as it may have become: cut off, damaged in the middle, with messages of others.
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
  std::int64_t utime = 0;  ///< When it was logged, whatever clock that was by.
  std::string channel;
  std::vector<std::uint8_t> bytes;
};

/// Reads the events of a log, one after the other.
///
/// LCM's own reader believes the lengths that it finds and ends at the first wrong one. Here an
/// event counts where it is whole and does not reach over another; what is none is passed over, up
/// to the next mark of an event, and counted.
class LogReader {
 public:
  /// @throws SetupError  when the file cannot be read.
  explicit LogReader(const std::filesystem::path& file);

  /// Gives the next message; false at the end. Memory of `message` is reused.
  bool Next(LoggedMessage& message);

  /// Counts of passed-over parts so far.
  std::int64_t damaged_bytes() const { return damaged_bytes_; }
  std::int64_t damaged_places() const { return damaged_places_; }

 private:
  bool ReadEvent(std::int64_t place, LoggedMessage& message);
  bool ReadAt(std::int64_t place, void* to, std::size_t bytes);
  bool IsMark(std::int64_t place);
  std::int64_t NextMark(std::int64_t from);

  std::ifstream in_;
  std::int64_t size_ = 0;
  std::int64_t place_ = 0;  ///< Of the next event.
  std::int64_t damaged_bytes_ = 0, damaged_places_ = 0;
};

}  // namespace mocap
