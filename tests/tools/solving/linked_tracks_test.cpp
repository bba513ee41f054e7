#include "tools/solving/linked_tracks.h"

#include <gtest/gtest.h>

#include "config/load_config.h"

namespace mocap {
namespace {

// Sets at 10 Hz.
class Moments : public RecordedSets {
 public:
  int count() const override { return 1000; }
  std::int64_t capture_ns(int set) const override { return 100'000'000LL * set; }
  void Read(int, RecordedSet&) override {}
};

class Linked : public ::testing::Test {
 protected:
  // Somebody who stands at a place for ten sets.
  PersonTrack Track(double stature_mm, int first, double x_mm) const {
    PersonTrack track{BodyModel(table_, AverageSizes(stature_mm)), 0, {}};
    PoseState pose;
    pose.X_WT.p = Vector3(x_mm, 0, 1000);
    pose.theta = JointAngles::Zero(track.body.joint_count());
    for (int set = first; set < first + 10; ++set) track.Set(set, pose);
    return track;
  }
  static std::vector<int> NumbersOf(const std::map<int, PersonTrack>& people) {
    std::vector<int> numbers;
    for (const auto& [number, track] : people) numbers.push_back(number);
    return numbers;
  }

  const BodyTable table_ = LoadBodyTable("full");
  const Moments sets_;
};

TEST_F(Linked, SomebodyFoundWhereAnotherWasLostGoesOn) {
  const auto people = LinkTracks({{1, Track(1750, 0, 0)}, {2, Track(1700, 14, 500)}}, sets_);
  ASSERT_EQ(NumbersOf(people), std::vector<int>{1});
  const PersonTrack& track = people.at(1);
  EXPECT_NE(track.At(9), nullptr);
  EXPECT_EQ(track.At(12), nullptr);
  EXPECT_NE(track.At(14), nullptr);
  EXPECT_EQ(track.end(), 24);
}

TEST_F(Linked, SomebodyWhoComesBackIsKnownByHisSizes) {
  const auto people = LinkTracks(
      {{1, Track(1750, 0, 0)}, {2, Track(1500, 0, 3000)}, {3, Track(1500, 200, 0)}}, sets_);
  EXPECT_EQ(NumbersOf(people), (std::vector<int>{1, 2}));
  EXPECT_EQ(people.at(2).end(), 210);
}

TEST_F(Linked, StrangersStayStrangers) {
  const auto people = LinkTracks({{1, Track(1750, 0, 0)}, {2, Track(1500, 200, 0)}}, sets_);
  EXPECT_EQ(NumbersOf(people), (std::vector<int>{1, 2}));
}

TEST_F(Linked, NobodyIsTwoPeopleAtOnce) {
  const auto people = LinkTracks({{1, Track(1750, 0, 0)}, {2, Track(1750, 5, 300)}}, sets_);
  EXPECT_EQ(NumbersOf(people), (std::vector<int>{1, 2}));
}

}  // namespace
}  // namespace mocap
