#include "daemon/pipeline/health_watch.h"

#include <gtest/gtest.h>

#include "tests/support/idle_threads.h"
#include "tests/support/walking_silhouettes.h"

namespace mocap {
namespace {

using testing::WalkOfTenSeconds;

SeenSet SetAt(std::size_t moment) {
  SeenSet set;
  for (const Silhouette& person : WalkOfTenSeconds().moments[moment]) {
    set.trimaps.push_back({person, Silhouette(person.width(), person.height())});
  }
  for (std::size_t c = 0; c < WalkOfTenSeconds().cameras.size(); ++c) {
    set.cameras.push_back(static_cast<int>(c));
    set.X_CW.push_back(WalkOfTenSeconds().cameras[c].X_CW);
  }
  return set;
}

TEST(HealthWatch, KnowsTheCamerasOnceSomebodyHasWalkedAbout) {
  HealthWatch watch(WalkOfTenSeconds().cameras);
  for (std::size_t moment = 0; moment < 10; ++moment) watch.Add(SetAt(moment));
  int known = 0;
  for (const CameraHealth& health : watch.Health()) {
    if (health.moments < HealthWatch::kFewestMoments) continue;
    ++known;
    EXPECT_LT(health.shift_px.norm(), 1.5);
    EXPECT_GT(health.overlap, 0.75);
  }
  EXPECT_GE(known, 4);
}

TEST(HealthWatch, NamesTheCameraThatWasTurnedAsTheOneFarthestOff) {
  HealthWatch watch(WalkOfTenSeconds().cameras);
  const Matrix3 turn = ExpRotation(Vector3(0.005, 0.01, 0));
  for (std::size_t moment = 0; moment < 10; ++moment) {
    SeenSet set = SetAt(moment);
    set.X_CW[3] = {turn * set.X_CW[3].R, turn * set.X_CW[3].p};
    watch.Add(set);
  }
  const std::vector<CameraHealth> health = watch.Health();
  EXPECT_GT(health[3].shift_px.norm(), 3);
  for (std::size_t c = 0; c < health.size(); ++c) {
    if (c == 3) continue;
    EXPECT_LT(health[c].shift_px.norm(), health[3].shift_px.norm()) << c;
  }
}

// Idle threads end late on busy processors, and a start may be ended at once.
TEST(HealthWatch, HasNoIdleThreadBeforeTheFirstSet) {
  HealthWatch watch(WalkOfTenSeconds().cameras);
  EXPECT_EQ(testing::CountIdleThreads(), 0);
  watch.tap().Offer([](SeenSet& set) {
    set = SetAt(0);
    return true;
  });
  EXPECT_EQ(testing::CountIdleThreads(), 1);
}

TEST(HealthWatch, WhoStandsStillCountsOnce) {
  HealthWatch watch(WalkOfTenSeconds().cameras);
  for (int i = 0; i < 8; ++i) watch.Add(SetAt(0));
  for (const CameraHealth& health : watch.Health()) EXPECT_LE(health.moments, 1);
}

/// A set with its hull, whose first camera knows nothing of the upper half of the people.
SeenSet HalfUnknownSet(std::size_t moment) {
  SeenSet set = SetAt(moment);
  Trimap& first = set.trimaps.front();
  const std::optional<PixelBox> box = first.person.BoundingBox();
  for (int y = box->top; y < (box->top + box->bottom) / 2; ++y) {
    const Silhouette all = first.person;
    for (int word = 0; word < all.words_per_row(); ++word) {
      first.unknown.row(y)[word] = all.row(y)[word];
      first.person.row(y)[word] = 0;
    }
  }
  const std::vector<CameraCalibration>& cameras = WalkOfTenSeconds().cameras;
  const std::vector<SensorPlaneTable> tables(cameras.begin(), cameras.end());
  std::vector<CarvingView> views;
  for (std::size_t c = 0; c < tables.size(); ++c) {
    views.push_back({&tables[c], &set.trimaps[c].person, set.X_CW[c], &set.trimaps[c].unknown});
  }
  Carver({.voxel_mm = 40}).Carve(views, set.hull);
  return set;
}

TEST(HealthWatch, TellsHowMuchOfThePeopleACameraDoesNotKnow) {
  HealthWatch watch(WalkOfTenSeconds().cameras);
  for (int i = 0; i < HealthWatch::kFewestMoments; ++i) {
    for (const CameraHealth& health : watch.Health()) EXPECT_FALSE(health.unknown_share) << i;
    watch.Add(HalfUnknownSet(static_cast<std::size_t>(i)));
  }
  const std::vector<CameraHealth> health = watch.Health();
  EXPECT_NEAR(health[0].unknown_share.value(), 0.5, 0.2);
  for (std::size_t c = 1; c < health.size(); ++c)
    EXPECT_EQ(health[c].unknown_share.value(), 0) << c;
}

TEST(HealthWatch, TellsWhatCarvingFoundEachCameraToMiss) {
  HealthWatch watch(WalkOfTenSeconds().cameras);
  SeenSet set = SetAt(0);
  set.miss_rates.assign(set.cameras.size(), {});
  set.miss_rates[1] = 0.25;
  watch.Add(set);
  EXPECT_FALSE(watch.Health()[0].miss_rate);
  EXPECT_EQ(watch.Health()[1].miss_rate, 0.25);
}

TEST(HealthWatch, NobodyIsNotUnknown) {
  HealthWatch watch(WalkOfTenSeconds().cameras);
  for (std::size_t moment = 0; moment < 2 * HealthWatch::kFewestMoments; ++moment) {
    SeenSet set = HalfUnknownSet(moment);
    set.hull.Reset({0, 0, 0}, {4, 4, 4}, 40);
    set.hull.Set(1, 1, 1);
    watch.Add(set);
  }
  for (const CameraHealth& health : watch.Health()) EXPECT_FALSE(health.unknown_share);
}

TEST(HealthWatch, AMissingCameraLeavesTheOthersTheirPlaces) {
  HealthWatch watch(WalkOfTenSeconds().cameras);
  for (std::size_t moment = 0; moment < 10; ++moment) {
    SeenSet set = SetAt(moment);
    set.cameras.erase(set.cameras.begin());
    set.trimaps.erase(set.trimaps.begin());
    set.X_CW.erase(set.X_CW.begin());
    watch.Add(set);
  }
  EXPECT_EQ(watch.Health()[0].moments, 0);
  for (const CameraHealth& health : watch.Health()) EXPECT_LT(health.shift_px.norm(), 2);
}

}  // namespace
}  // namespace mocap
