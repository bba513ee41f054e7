#include "daemon/pipeline/people_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/walking_moments.h"

namespace mocap {
namespace {

using testing::ExchangePictures;
using ::testing::HasSubstr;
using testing::WalkingMoments;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// Shows the moments a second apart.
SeenPeople AfterAll(const std::vector<SeenMoment>& moments) {
  PeopleWatch watch(testing::WalkCameras());
  SeenPeople people;
  for (std::size_t i = 0; i < moments.size(); ++i)
    people = watch.Add(static_cast<std::int64_t>(i) * kSecond_ns, moments[i]);
  return people;
}

TEST(PeopleWatch, SomebodyWhoWalksIsSomebodyAfterFiveSeconds) {
  PeopleWatch watch(testing::WalkCameras());
  const std::vector<SeenMoment> moments = WalkingMoments();
  for (int s = 0; s < 10; ++s) {
    const SeenPeople people = watch.Add(s * kSecond_ns, moments[static_cast<std::size_t>(s)]);
    EXPECT_EQ(people.is_somebody(), s >= 5) << s;
    EXPECT_FALSE(people.fault);
  }
}

TEST(PeopleWatch, ACalibrationThatMixesCamerasUpIsTold) {
  std::vector<SeenMoment> moments = WalkingMoments();
  ExchangePictures(1, 4, moments);
  const SeenPeople people = AfterAll(moments);
  ASSERT_TRUE(people.fault);
  EXPECT_THAT(people.fault->text, HasSubstr("cam2 and cam5 have each other's name"));
}

TEST(PeopleWatch, FurnitureAndAnEmptyRoomAreNobody) {
  EXPECT_FALSE(AfterAll(std::vector<SeenMoment>(10, WalkingMoments()[0])).is_somebody());
  std::vector<SeenMoment> empty = WalkingMoments();
  for (SeenMoment& moment : empty)
    for (auto& shape : moment) shape = ShapeOf(Silhouette(320, 240), shape->X_CW);
  EXPECT_FALSE(AfterAll(empty).is_somebody());
}

TEST(PeopleWatch, SomethingSmallThatMovesIsNobody) {
  std::vector<SeenMoment> moments = WalkingMoments();
  for (SeenMoment& moment : moments)
    for (auto& shape : moment) shape->X_CW.p /= 2;
  EXPECT_FALSE(AfterAll(moments).is_somebody()) << "a person of 0.86 m";
}

TEST(PeopleWatch, SomethingSmallThatNeverRestsIsAPersonOfWrongScale) {
  std::vector<SeenMoment> moments;
  for (int i = 0; i < 40; ++i) {
    moments.push_back(WalkingMoments()[static_cast<std::size_t>(i) % 10]);
    for (auto& shape : moments.back()) shape->X_CW.p /= 2;
  }
  const SeenPeople people = AfterAll(moments);
  ASSERT_TRUE(people.fault);
  EXPECT_THAT(people.fault->text, HasSubstr("the size of the board's squares"));
}

TEST(PeopleWatch, WhoWasAwayCountsAnew) {
  std::vector<SeenMoment> moments = WalkingMoments();
  for (auto& shape : moments[6]) shape = ShapeOf(Silhouette(320, 240), shape->X_CW);
  EXPECT_FALSE(AfterAll(moments).is_somebody());
}

TEST(PeopleWatch, TimesThatGoBackBeginAnew) {
  PeopleWatch watch(testing::WalkCameras());
  const std::vector<SeenMoment> moments = WalkingMoments();
  for (int s = 0; s < 8; ++s) watch.Add(s * kSecond_ns, moments[static_cast<std::size_t>(s)]);
  EXPECT_FALSE(watch.Add(0, moments[8]).is_somebody());
}

}  // namespace
}  // namespace mocap
