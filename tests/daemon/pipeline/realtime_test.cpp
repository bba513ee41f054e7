#include "daemon/pipeline/realtime.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <thread>

#include "core/errors.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

// A processor that this process may use.
int SomeProcessor() {
  cpu_set_t allowed;
  sched_getaffinity(0, sizeof allowed, &allowed);
  int processor = CPU_SETSIZE - 1;
  while (!CPU_ISSET(processor, &allowed)) --processor;
  return processor;
}

TEST(Realtime, ThreadKeepsToTheProcessorsThatItIsGiven) {
  const int wanted = SomeProcessor();
  int ran_on = -1;
  std::thread([&] {
    EXPECT_TRUE(KeepToProcessors({wanted}));
    std::this_thread::yield();
    ran_on = sched_getcpu();
  }).join();
  EXPECT_EQ(ran_on, wanted);
}

TEST(Realtime, ProcessorThatIsNotThereIsRefusedInOneLine) {
  RealtimeConfig config;
  config.processors = {SomeProcessor(), CPU_SETSIZE - 1};
  try {
    PrepareRealtime(config);
    ADD_FAILURE() << "was accepted";
  } catch (const SetupError& error) {
    EXPECT_THAT(error.what(), HasSubstr("realtime.processors"));
  }
}

TEST(Realtime, TryingTheProcessorsLeavesTheThreadWhereItMayRun) {
  cpu_set_t before, after;
  sched_getaffinity(0, sizeof before, &before);
  RealtimeConfig config;
  config.processors = {SomeProcessor()};
  PrepareRealtime(config);
  sched_getaffinity(0, sizeof after, &after);
  EXPECT_TRUE(CPU_EQUAL(&before, &after));
}

TEST(Realtime, FramePathIsAheadOfOtherProgramsWhereLimitsAllowIt) {
  RealtimeConfig config;
  EXPECT_EQ(FramePathPriority(config), MayTakePriority(kUsualPriority) ? kUsualPriority : 0);
  EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER);
  for (const int configured : {0, 3}) {
    config.priority = configured;
    EXPECT_EQ(FramePathPriority(config), configured);
  }
}

TEST(Realtime, LongTurnsKeepAThreadAsNiceAsItWas) {
  constexpr int kNice = 3;
  std::thread([&] {
    const auto thread = static_cast<id_t>(gettid());
    setpriority(PRIO_PROCESS, thread, kNice);
    WorkInLongTurns();
    EXPECT_EQ(sched_getscheduler(0), SCHED_BATCH);
    EXPECT_EQ(getpriority(PRIO_PROCESS, thread), kNice);
  }).join();
}

}  // namespace
}  // namespace mocap
