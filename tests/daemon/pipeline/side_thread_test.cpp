#include "daemon/pipeline/side_thread.h"

#include <gtest/gtest.h>

#include <future>
#include <thread>
#include <vector>

namespace mocap {
namespace {

TEST(SideThread, WorksInTheOrderOfWhatWasBegun) {
  SideThread side("aside", {});
  std::vector<int> order;
  std::promise<void> done;
  for (int i = 0; i < 20; ++i) side.Begin([&order, i] { order.push_back(i); });
  side.Begin([&done] { done.set_value(); });
  done.get_future().wait();
  ASSERT_EQ(order.size(), 20u);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(order[i], i);
}

TEST(SideThread, IsAnotherThread) {
  SideThread side("aside", {});
  std::promise<std::thread::id> id;
  side.Begin([&id] { id.set_value(std::this_thread::get_id()); });
  EXPECT_NE(id.get_future().get(), std::this_thread::get_id());
}

}  // namespace
}  // namespace mocap
