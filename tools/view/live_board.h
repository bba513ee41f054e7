// The latest of everything that pages are told, and who has yet to hear it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mocap {

/// What goes to a page at once. Shared by all who get it.
struct LiveMessage {
  bool is_text = false;  ///< JSON; otherwise binary.
  std::shared_ptr<const std::string> bytes;
};

/// Keeps one message a slot: a new one takes the old one's place. A reader who is slow gets the
/// newest of each slot and never a queue. One thread.
class LiveBoard {
 public:
  /// A page: which slots it has yet to hear.
  class Reader {
   public:
    /// @param board  borrowed for the reader's life.
    explicit Reader(LiveBoard& board);
    ~Reader();
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    /// The next message that is due, in turns over the slots; empty: all is heard.
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
