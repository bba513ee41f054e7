// The latest messages for pages, and which page still lacks which.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mocap {

/// One message to a page. Shared by all receivers.
struct LiveMessage {
  bool is_text = false;  ///< JSON; otherwise binary.
  std::shared_ptr<const std::string> bytes;
  /// Until then, by the steady clock, it tells of the present: who comes later does not get it.
  std::int64_t until_ns = std::numeric_limits<std::int64_t>::max();
};

/// Keeps one message per slot; a new one replaces the old. A slow reader gets the newest of each
/// slot and never a queue. Single-threaded.
class LiveBoard {
 public:
  /// A page, with the slots that it still has to get.
  class Reader {
   public:
    /// Starts with what is on the board, unless it is out of date at `now_ns`.
    /// @param board  must outlive the reader.
    Reader(LiveBoard& board, std::int64_t now_ns);
    ~Reader();
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    /// The next new message, in turns over the slots; empty: there is none.
    std::optional<LiveMessage> Next();

   private:
    friend class LiveBoard;
    LiveBoard& board_;
    std::vector<bool> is_due_;
    std::size_t last_ = 0;
  };

  void Put(std::size_t slot, LiveMessage message);
  std::size_t readers() const { return readers_.size(); }

 private:
  std::vector<LiveMessage> latest_;
  std::vector<Reader*> readers_;
};

}  // namespace mocap
