#include "daemon/service/live_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "config/load_config.h"
#include "tests/support/still_capture.h"

namespace mocap {
namespace {

using testing::StillCapture;

class LiveViewTest : public ::testing::Test {
 protected:
  LiveViewTest() {
    result_.state = CaptureState::kTracking;
    result_.points_W.col(static_cast<int>(Point::kTorso)) = Vector3(500, -200, 1100);
    result_.residual_mm = 12;
  }
  void See(std::span<const PersonView> people) {
    view_.OnSet({.result = result_, .body = body_, .people = people, .grid = grid_});
  }
  std::vector<int> Ids() const {
    std::vector<int> ids;
    for (const FollowedPerson& person : view_.people()) ids.push_back(person.id);
    return ids;
  }

  const BodyModel body_{LoadBodyTable("full"), AverageSizes(1700)};
  const VoxelGrid grid_;
  CaptureResult result_;
  LiveView view_{{}};
};

TEST_F(LiveViewTest, TellsOfEachWhoIsFollowed) {
  const StillCapture capture(body_, result_);
  See(std::array{PersonView{3, &capture, "anna"}});
  const std::vector<FollowedPerson> people = view_.people();
  ASSERT_EQ(people.size(), 1u);
  EXPECT_EQ(people[0].id, 3);
  EXPECT_EQ(people[0].name, "anna");
  EXPECT_EQ(people[0].state, CaptureState::kTracking);
  EXPECT_EQ(people[0].torso_W, Vector3(500, -200, 1100));
  EXPECT_EQ(people[0].residual_mm, 12);
  EXPECT_EQ(people[0].sizes, body_.sizes());
}

TEST_F(LiveViewTest, WhoeverStaysHasBeenThereSinceTheFirstTime) {
  const StillCapture capture(body_, result_);
  See(std::array{PersonView{1, &capture}, PersonView{2, &capture}});
  const std::int64_t since_ns = view_.people()[1].since_ns;
  See(std::array{PersonView{2, &capture}, PersonView{4, &capture}});
  EXPECT_THAT(Ids(), ::testing::ElementsAre(2, 4));
  EXPECT_EQ(view_.people()[0].since_ns, since_ns);
  EXPECT_GE(view_.people()[1].since_ns, since_ns);
  See({});
  EXPECT_THAT(Ids(), ::testing::IsEmpty());
}

TEST_F(LiveViewTest, TheLineCountsPeopleWhereThereAreSeveral) {
  const StillCapture capture(body_, result_);
  const std::array people = {PersonView{1, &capture}, PersonView{2, &capture}};
  See(std::span(people).first(1));
  EXPECT_THAT(view_.Line({}), ::testing::Not(::testing::HasSubstr("people")));
  See(people);
  EXPECT_THAT(view_.Line({}), ::testing::HasSubstr("2 people"));
}

}  // namespace
}  // namespace mocap
