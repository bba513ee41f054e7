#include "daemon/pipeline/frame_progress.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

/// Two cameras, all at rest.
FrameProgress AtRest() {
  FrameProgress progress;
  progress.cameras.resize(2);
  return progress;
}

/// Everything has done one turn more.
FrameProgress Onward(FrameProgress progress) {
  for (FrameProgress::Thread& camera : progress.cameras) ++camera.turns;
  ++progress.carving.turns;
  return progress;
}

TEST(ProgressWatch, IsContentWhileEveryThreadComesRound) {
  ProgressWatch watch;
  FrameProgress now = AtRest();
  EXPECT_FALSE(watch.HasMoved(now)) << "nothing to compare with yet";
  for (int i = 0; i < 3; ++i) {
    now = Onward(now);
    EXPECT_TRUE(watch.HasMoved(now));
  }
}

TEST(ProgressWatch, OneCameraThatHangsIsEnoughToStopIt) {
  ProgressWatch watch;
  FrameProgress now = AtRest();
  watch.HasMoved(now);
  for (int i = 0; i < 3; ++i) {
    now = Onward(now);
    now.cameras[1].turns = 0;
    EXPECT_FALSE(watch.HasMoved(now));
  }
  now.cameras[1].turns = 1;
  EXPECT_TRUE(watch.HasMoved(now)) << "it came back";
}

TEST(ProgressWatch, ACameraThatHasEndedIsNotWaitedFor) {
  ProgressWatch watch;
  FrameProgress now = AtRest();
  watch.HasMoved(now);
  now = Onward(now);
  now.cameras[1] = {.turns = 0, .has_ended = true};
  EXPECT_TRUE(watch.HasMoved(now));
}

TEST(ProgressWatch, CarvingThatHangsStopsIt) {
  ProgressWatch watch;
  FrameProgress now = AtRest();
  watch.HasMoved(now);
  now = Onward(now);
  now.carving.turns = 0;
  EXPECT_FALSE(watch.HasMoved(now));
}

TEST(ProgressWatch, TrackingMustMoveOnlyWhileSetsWait) {
  ProgressWatch watch;
  FrameProgress now = AtRest();
  watch.HasMoved(now);
  now = Onward(now);
  EXPECT_TRUE(watch.HasMoved(now)) << "an empty studio has no sets";
  now = Onward(now);
  now.sets_matched = 2;
  EXPECT_FALSE(watch.HasMoved(now));
  now = Onward(now);
  now.sets_tracked = 1;
  EXPECT_TRUE(watch.HasMoved(now));
}

}  // namespace
}  // namespace mocap
