#include "tools/view/live_board.h"

#include <algorithm>
#include <utility>

namespace mocap {

LiveBoard::Reader::Reader(LiveBoard& board, std::int64_t now_ns) : board_(board) {
  for (const LiveMessage& message : board.latest_)
    is_due_.push_back(message.bytes != nullptr && now_ns <= message.until_ns);
  board.readers_.push_back(this);
}

LiveBoard::Reader::~Reader() { std::erase(board_.readers_, this); }

std::optional<LiveMessage> LiveBoard::Reader::Next() {
  for (std::size_t i = 1; i <= is_due_.size(); ++i) {
    const std::size_t slot = (last_ + i) % is_due_.size();
    if (!is_due_[slot]) continue;
    is_due_[slot] = false;
    last_ = slot;
    return board_.latest_[slot];
  }
  return {};
}

void LiveBoard::Put(std::size_t slot, LiveMessage message) {
  if (slot >= latest_.size()) latest_.resize(slot + 1);
  latest_[slot] = std::move(message);
  for (Reader* reader : readers_) {
    reader->is_due_.resize(latest_.size());
    reader->is_due_[slot] = true;
  }
}

}  // namespace mocap
