#include "tools/view/live_board.h"

#include <gtest/gtest.h>

#include <string>

namespace mocap {
namespace {

LiveMessage Message(const std::string& text) {
  return {true, std::make_shared<const std::string>(text)};
}

std::string NextOf(LiveBoard::Reader& reader) {
  const std::optional<LiveMessage> message = reader.Next();
  return message ? *message->bytes : "-";
}

TEST(LiveBoard, WhoComesLaterHearsTheLatestOfEachSlot) {
  LiveBoard board;
  board.Put(0, Message("old studio"));
  board.Put(0, Message("studio"));
  board.Put(3, Message("pose"));
  LiveBoard::Reader reader(board, 0);
  EXPECT_EQ(NextOf(reader), "pose");
  EXPECT_EQ(NextOf(reader), "studio");
  EXPECT_EQ(NextOf(reader), "-");
}

TEST(LiveBoard, WhoComesLaterHearsNothingThatIsOutOfDate) {
  LiveBoard board;
  board.Put(0, Message("studio"));
  LiveMessage pose = Message("pose");
  pose.until_ns = 100;
  board.Put(1, pose);
  LiveBoard::Reader in_time(board, 100), late(board, 101);
  EXPECT_EQ(NextOf(in_time), "pose");
  EXPECT_EQ(NextOf(late), "studio");
  EXPECT_EQ(NextOf(late), "-");
  board.Put(1, pose);
  EXPECT_EQ(NextOf(late), "pose");
}

TEST(LiveBoard, ASlowReaderGetsTheNewestAndNoQueue) {
  LiveBoard board;
  LiveBoard::Reader reader(board, 0);
  for (int i = 0; i < 1000; ++i) board.Put(0, Message("pose " + std::to_string(i)));
  EXPECT_EQ(NextOf(reader), "pose 999");
  EXPECT_EQ(NextOf(reader), "-");
}

TEST(LiveBoard, ABusySlotDoesNotStarveTheOthers) {
  LiveBoard board;
  LiveBoard::Reader reader(board, 0);
  board.Put(1, Message("status"));
  board.Put(0, Message("pose"));
  EXPECT_EQ(NextOf(reader), "status");
  board.Put(1, Message("status"));
  EXPECT_EQ(NextOf(reader), "pose");
}

TEST(LiveBoard, EachReaderHearsForItself) {
  LiveBoard board;
  LiveBoard::Reader first(board, 0);
  {
    LiveBoard::Reader second(board, 0);
    board.Put(0, Message("pose"));
    EXPECT_EQ(board.readers(), 2u);
    EXPECT_EQ(NextOf(second), "pose");
  }
  EXPECT_EQ(board.readers(), 1u);
  EXPECT_EQ(NextOf(first), "pose");
}

}  // namespace
}  // namespace mocap
