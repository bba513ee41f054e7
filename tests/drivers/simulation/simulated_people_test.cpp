#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "drivers/simulation/simulated_studio.h"
#include "drivers/virtual_studio/scene.h"
#include "drivers/virtual_studio/truth.h"
#include "tests/support/pixels.h"

namespace mocap {
namespace {

using simulation::BonePoses;

SimulatedStudioOptions SmallStudio(const std::string& motion, int people) {
  SimulatedStudioOptions options = RecordedSimulation();
  options.motion = motion;
  options.people = people;
  options.width_px = 320;
  options.height_px = 240;
  options.seconds = 1;
  return options;
}

TEST(SimulatedPeople, LeaveTheFirstAndTheRoomAsOneHasThem) {
  SimulatedStudioOptions options = SmallStudio("walk", 1);
  const simulation::Scene alone(options);
  options.people = 3;
  const simulation::Scene company(options);
  const simulation::Figure &one = alone.figures()[0], &first = company.figures()[0];
  EXPECT_EQ(one.outfit.colors, first.outfit.colors);
  ASSERT_EQ(one.mesh.vertices.size(), first.mesh.vertices.size());
  for (std::size_t i = 0; i < one.mesh.vertices.size(); ++i)
    ASSERT_EQ(one.mesh.vertices[i].p_rest, first.mesh.vertices[i].p_rest);
  EXPECT_EQ(Pixels(SimulatedStudio(options).Background(2)[5].image.view()),
            Pixels(SimulatedStudio(SmallStudio("walk", 1)).Background(2)[5].image.view()));
}

TEST(SimulatedPeople, MayBeInTheMiddleOfTheirMotionAtTheStart) {
  SimulatedStudioOptions options = SmallStudio("lie", 2);
  const SimulatedTruth whole(options);
  options.begin_s = 8;
  const SimulatedTruth late(options);
  for (int person = 0; person < 2; ++person)
    EXPECT_EQ(late.At(options.start_ns, person),
              whole.At(options.start_ns + 8'000'000'000, person));
}

// Each figure alone, and all together, before the same empty view.
TEST(SimulatedPeople, AreSeenAsIfAloneWhereNobodyStandsBefore) {
  const SimulatedStudioOptions options = SmallStudio("dance", 3);
  const auto scene = std::make_shared<const simulation::Scene>(options);
  const std::vector<BonePoses> poses = scene->BonesAt(options.start_ns);
  int overlaps = 0, in_order = 0;
  for (int c = 0; c < 6; ++c) {
    const simulation::SceneView view(scene, c);
    const RigidTransform& X_CW = scene->cameras()[c].X_CW;
    simulation::PersonRenderer renderer(scene->cameras()[c]);
    Image<Bgr> canvas;
    std::vector<Image<std::uint8_t>> alone;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      renderer.Draw(std::span(scene->figures()).subspan(i, 1), std::span(poses).subspan(i, 1),
                    view.fixed_view(), X_CW, false, canvas);
      alone.push_back(renderer.figures());
    }
    renderer.Draw(scene->figures(), poses, view.fixed_view(), X_CW, false, canvas);
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 320; ++x) {
        const int seen = simulation::FigurePixel::FigureOf(renderer.figures()(x, y));
        std::vector<int> there;
        for (int i = 0; i < 3; ++i)
          if (alone[i](x, y) != 0) there.push_back(i);
        ASSERT_EQ(seen >= 0, !there.empty()) << x << ' ' << y;
        if (seen < 0) continue;
        ASSERT_NE(alone[seen](x, y), 0) << x << ' ' << y;
        EXPECT_EQ(simulation::FigurePixel::MaterialOf(renderer.figures()(x, y)),
                  simulation::FigurePixel::MaterialOf(alone[seen](x, y)));
        if (there.size() < 2) continue;
        ++overlaps;
        const auto depth = [&](int i) { return (X_CW * poses[i][simulation::kThorax].p).z(); };
        in_order += std::ranges::all_of(there, [&](int i) { return depth(seen) <= depth(i); });
      }
  }
  ASSERT_GT(overlaps, 500);
  // Arms may reach before who is nearer.
  EXPECT_GT(in_order, 0.95 * overlaps);
}

TEST(SimulatedPeople, PresenceTellsWhoIsInTheRoomAndInHowManyPictures) {
  const SimulatedStudioOptions options = SmallStudio("visit", 2);
  const SimulatedStudio studio(options);
  const PersonPresence stays = studio.PresenceOf(0, options.start_ns);
  EXPECT_TRUE(stays.in_room && stays.whole);
  EXPECT_GE(stays.pictures, kCoveringPictures);
  const PersonPresence absent = studio.PresenceOf(1, options.start_ns);
  EXPECT_FALSE(absent.in_room || absent.whole);
  const PersonPresence later = studio.PresenceOf(1, options.start_ns + 9'000'000'000);
  EXPECT_TRUE(later.in_room && later.whole);
  EXPECT_GE(later.pictures, kCoveringPictures);

  const auto scene = std::make_shared<const simulation::Scene>(options);
  for (int c = 0; c < 6; ++c) {
    simulation::ScenePainter painter(std::make_shared<const simulation::SceneView>(scene, c));
    const auto is_seen = [&](std::int64_t time_ns) {
      painter.Paint(time_ns);
      return std::ranges::any_of(painter.figures().pixels(), [](std::uint8_t pixel) {
        return simulation::FigurePixel::FigureOf(pixel) == 1;
      });
    };
    EXPECT_FALSE(is_seen(options.start_ns)) << c;
    EXPECT_TRUE(is_seen(options.start_ns + 9'000'000'000)) << c;
  }
}

}  // namespace
}  // namespace mocap
