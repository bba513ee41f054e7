#include "daemon/status/followed_person.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

FollowedPerson Person(int id, const std::string& name = {},
                      CaptureState state = CaptureState::kTracking) {
  FollowedPerson person;
  person.id = id;
  person.name = name;
  person.state = state;
  return person;
}

std::string WhyNot(std::span<const FollowedPerson> people, std::optional<int> id) {
  try {
    ChoosePerson(people, id);
  } catch (const SetupError& error) {
    return error.what();
  }
  return {};
}

TEST(FollowedPerson, TheOnlyOneIsMeantWithoutANumber) {
  const std::vector<FollowedPerson> people = {Person(4)};
  EXPECT_EQ(ChoosePerson(people, {}).id, 4);
  EXPECT_EQ(ChoosePerson(people, 4).id, 4);
}

TEST(FollowedPerson, OfSeveralTheNumberTellsWhoIsMeant) {
  const std::vector<FollowedPerson> people = {Person(2), Person(5, "anna")};
  EXPECT_EQ(ChoosePerson(people, 5).name, "anna");
}

TEST(FollowedPerson, WhoeverAsksWronglyLearnsWhoIsThere) {
  const std::vector<FollowedPerson> people = {Person(2), Person(5, "anna")};
  EXPECT_THAT(WhyNot(people, {}),
              HasSubstr("person 2, person 5 (anna); choose one of them with --person"));
  EXPECT_THAT(WhyNot(people, 3), HasSubstr("person 3 is not tracked"));
  EXPECT_THAT(WhyNot(people, 3), HasSubstr("person 2, person 5 (anna)"));
}

TEST(FollowedPerson, WhoIsLostIsNotTracked) {
  const auto tracked = Tracked({Person(1, {}, CaptureState::kLost), Person(2)});
  ASSERT_EQ(tracked.size(), 1u);
  EXPECT_EQ(tracked[0].id, 2);
}

}  // namespace
}  // namespace mocap
