#include "daemon/pipeline/side_thread.h"

#include <gtest/gtest.h>

#include <functional>
#include <future>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace mocap {
namespace {

const SideThread::Guard kPlain = [](const std::function<void()>& work) { work(); };

TEST(SideThread, WorksInTheOrderOfWhatWasBegun) {
  SideThread side("aside", {}, kPlain);
  std::vector<int> order;
  std::promise<void> done;
  for (int i = 0; i < 20; ++i) side.Do([&order, i] { order.push_back(i); });
  side.Do([&done] { done.set_value(); });
  done.get_future().wait();
  ASSERT_EQ(order.size(), 20u);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(order[i], i);
}

TEST(SideThread, IsAnotherThread) {
  SideThread side("aside", {}, kPlain);
  std::promise<std::thread::id> id;
  side.Do([&id] { id.set_value(std::this_thread::get_id()); });
  EXPECT_NE(id.get_future().get(), std::this_thread::get_id());
}

TEST(SideThread, RefusesWhatIsTooMuchAndDoesNotWait) {
  std::promise<void> may_go_on;
  const std::shared_future<void> goes_on = may_go_on.get_future().share();
  SideThread side("aside", {}, kPlain);
  int begun = 0;
  while (begun < 1000 && side.Do([goes_on] { goes_on.wait(); })) ++begun;
  EXPECT_GT(begun, 8);
  EXPECT_LT(begun, 1000);
  may_go_on.set_value();
}

TEST(SideThread, HandsWhatIsThrownToItsGuard) {
  std::promise<std::string> told;
  SideThread side("aside", {}, [&](const std::function<void()>& work) {
    try {
      work();
    } catch (const std::runtime_error& error) {
      told.set_value(error.what());
    }
  });
  side.Do([] { throw std::runtime_error("no flesh"); });
  EXPECT_EQ(told.get_future().get(), "no flesh");
}

}  // namespace
}  // namespace mocap
