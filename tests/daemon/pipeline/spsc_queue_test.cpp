#include "daemon/pipeline/spsc_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

namespace mocap {
namespace {

/// Long enough to be torn visibly if a producer wrote while a consumer read.
struct Item {
  std::vector<int> values = std::vector<int>(64);
};

void Fill(Item& item, int number) { std::ranges::fill(item.values, number); }

bool IsWhole(const Item& item) {
  return std::ranges::all_of(item.values, [&](int v) { return v == item.values[0]; });
}

/// Pops until closed and empty; gives the numbers in the order of arrival, -1 for a torn item.
std::vector<int> Drain(SpscQueue<Item>& queue, Doorbell& bell) {
  std::vector<int> numbers;
  for (;;) {
    const int seen = bell.count();
    const bool closed = queue.closed();
    if (queue.TryPop()) {
      numbers.push_back(IsWhole(queue.front()) ? queue.front().values[0] : -1);
    } else if (closed) {
      return numbers;
    } else {
      bell.WaitPast(seen);
    }
  }
}

std::vector<int> Transfer(int items, std::size_t capacity, Overflow overflow,
                          std::int64_t* dropped) {
  Doorbell bell;
  SpscQueue<Item> queue(capacity, overflow, bell);
  std::thread producer([&] {
    for (int i = 0; i < items; ++i) {
      Fill(queue.back(), i);
      queue.Push();
    }
    queue.Close();
  });
  const std::vector<int> numbers = Drain(queue, bell);
  producer.join();
  *dropped = queue.dropped();
  return numbers;
}

TEST(SpscQueue, WaitingLosesNothingAndKeepsTheOrder) {
  for (const std::size_t capacity : {1, 3, 16}) {
    std::int64_t dropped = 0;
    const std::vector<int> numbers = Transfer(20000, capacity, Overflow::kWait, &dropped);
    ASSERT_EQ(numbers.size(), 20000u);
    for (int i = 0; i < 20000; ++i) ASSERT_EQ(numbers[i], i);
    EXPECT_EQ(dropped, 0);
  }
}

TEST(SpscQueue, DroppingKeepsTheOrderAndCountsWhatIsMissing) {
  for (const std::size_t capacity : {1, 2, 5}) {
    std::int64_t dropped = 0;
    const std::vector<int> numbers = Transfer(20000, capacity, Overflow::kDropOldest, &dropped);
    ASSERT_FALSE(numbers.empty());
    EXPECT_GE(numbers.front(), 0);
    for (std::size_t i = 1; i < numbers.size(); ++i) ASSERT_GT(numbers[i], numbers[i - 1]);
    EXPECT_EQ(numbers.back(), 19999) << "the newest is never the one to go";
    EXPECT_EQ(static_cast<std::int64_t>(numbers.size()) + dropped, 20000);
  }
}

TEST(SpscQueue, DroppingTakesTheOldestFirst) {
  Doorbell bell;
  SpscQueue<int> queue(3, Overflow::kDropOldest, bell);
  for (int i = 0; i < 8; ++i) {
    queue.back() = i;
    queue.Push();
  }
  queue.Close();
  for (const int expected : {5, 6, 7}) {
    ASSERT_TRUE(queue.TryPop());
    EXPECT_EQ(queue.front(), expected);
  }
  EXPECT_FALSE(queue.TryPop());
  EXPECT_EQ(queue.dropped(), 5);
}

TEST(SpscQueue, ClosedStillGivesWhatWasPushedButTakesNothingMore) {
  Doorbell bell;
  SpscQueue<int> queue(2, Overflow::kWait, bell);
  queue.back() = 1;
  queue.Push();
  queue.Close();
  queue.back() = 2;
  queue.Push();
  ASSERT_TRUE(queue.TryPop());
  EXPECT_EQ(queue.front(), 1);
  EXPECT_FALSE(queue.TryPop());
}

TEST(SpscQueue, ClosingFreesAProducerThatWaits) {
  Doorbell bell;
  SpscQueue<int> queue(1, Overflow::kWait, bell);
  std::thread producer([&] {
    for (int i = 0; i < 3; ++i) queue.Push();
  });
  bell.WaitPast(0);
  queue.Close();
  producer.join();
  EXPECT_TRUE(queue.TryPop());
  EXPECT_FALSE(queue.TryPop());
}

TEST(SpscQueue, ReusesItsSlots) {
  Doorbell bell;
  SpscQueue<std::vector<int>> queue(2, Overflow::kDropOldest, bell);
  std::vector<const int*> blocks;
  for (int i = 0; i < 40; ++i) {
    queue.back().assign(1000, i);
    const int* block = queue.back().data();
    if (std::ranges::find(blocks, block) == blocks.end()) blocks.push_back(block);
    queue.Push();
    if (i % 3 == 0) {
      ASSERT_TRUE(queue.TryPop());
    }
  }
  EXPECT_LE(blocks.size(), 4u) << "the ring's two, the producer's and the consumer's";
}

}  // namespace
}  // namespace mocap
