#include "drivers/virtual_studio/rendering/person_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/errors.h"
#include "drivers/simulation/simulated_studio.h"
#include "drivers/virtual_studio/scene.h"

namespace mocap::simulation {
namespace {

SimulatedStudioOptions SmallRoom() {
  SimulatedStudioOptions options = RecordedSimulation();
  options.width_px = 320;
  options.height_px = 240;
  options.begin_s = 1;
  return options;
}

/// What a camera sees of the first moment, without the sensor's noise.
struct Drawn {
  Image<Bgr> empty, picture;
  Image<std::uint8_t> figures;

  /// Whether a pixel shows a material, and so do its neighbours, which edges would blend.
  bool Shows(int x, int y, Material material) const {
    const auto is = [&](int i, int j) {
      return figures(i, j) != 0 && FigurePixel::MaterialOf(figures(i, j)) == material;
    };
    return is(x, y) && is(x - 1, y) && is(x + 1, y) && is(x, y - 1) && is(x, y + 1);
  }
  int Difference(int x, int y) const { return picture(x, y).g - empty(x, y).g; }
  int LargestDifference(int x, int y) const {
    const Bgr a = picture(x, y), b = empty(x, y);
    return std::max({std::abs(a.b - b.b), std::abs(a.g - b.g), std::abs(a.r - b.r)});
  }
};

Drawn Draw(const SimulatedStudioOptions& options, int camera) {
  const auto scene = std::make_shared<const Scene>(options);
  const SceneView view(scene, camera);
  PersonRenderer renderer(view.calibration(), scene->StyleOf(camera));
  Drawn drawn{.empty = view.fixed_view().image, .picture = {}, .figures = {}};
  renderer.Draw(scene->figures(), scene->BonesAt(options.start_ns), view.fixed_view(),
                view.calibration().X_CW, false, drawn.picture);
  drawn.figures = renderer.figures();
  return drawn;
}

/// Calls visit(x, y) for all pixels but the picture's border.
template <typename Visit>
void ForEachInside(const Drawn& drawn, const Visit& visit) {
  for (int y = 1; y + 1 < drawn.figures.height(); ++y)
    for (int x = 1; x + 1 < drawn.figures.width(); ++x) visit(x, y);
}

TEST(PersonRenderer, ClothesDifferFromWhatIsBehindThemByTheContrastAtMost) {
  for (const double contrast : {10.0, 40.0}) {
    SimulatedStudioOptions options = SmallRoom();
    options.contrast = contrast;
    for (int camera = 0; camera < options.cameras; ++camera) {
      const Drawn drawn = Draw(options, camera);
      int clothes = 0, darker = 0, lighter = 0, most_of_skin = 0;
      ForEachInside(drawn, [&](int x, int y) {
        for (const Material material : {kShirt, kStripe, kTrousers, kShoes}) {
          if (!drawn.Shows(x, y, material)) continue;
          ASSERT_LE(drawn.LargestDifference(x, y), contrast) << x << ' ' << y;
          ++clothes;
          darker += drawn.Difference(x, y) < -contrast / 4;
          lighter += drawn.Difference(x, y) > contrast / 4;
        }
        for (const Material material : {kSkin, kHair}) {
          if (drawn.Shows(x, y, material))
            most_of_skin = std::max(most_of_skin, drawn.LargestDifference(x, y));
        }
      });
      EXPECT_GT(clothes, 200) << "camera " << camera;
      EXPECT_GT(darker, clothes / 8) << "camera " << camera;
      EXPECT_GT(lighter, clothes / 8) << "camera " << camera;
      EXPECT_GT(most_of_skin, 40) << "camera " << camera;
    }
  }
}

TEST(PersonRenderer, AMisledCameraSeesTheEmptyRoomInPlaceOfAGarment) {
  SimulatedStudioOptions options = SmallRoom();
  options.misled_share = 1;
  int of_shirts = 0;
  for (int camera = 0; camera < options.cameras; ++camera) {
    const Drawn drawn = Draw(options, camera);
    const HiddenClothes hidden = Scene(options).StyleOf(camera).hidden;
    ASSERT_NE(hidden, HiddenClothes::kNone);
    const bool hides_shirts = hidden == HiddenClothes::kShirts;
    of_shirts += hides_shirts;
    int covered = 0, seen = 0;
    ForEachInside(drawn, [&](int x, int y) {
      if (drawn.Shows(x, y, hides_shirts ? kShirt : kTrousers)) {
        EXPECT_EQ(drawn.LargestDifference(x, y), 0) << x << ' ' << y;
        ++covered;
      } else if (drawn.Shows(x, y, hides_shirts ? kTrousers : kShirt)) {
        seen += drawn.LargestDifference(x, y) > 0;
      }
    });
    EXPECT_GT(covered, 40) << "camera " << camera;
    EXPECT_GT(seen, 40) << "camera " << camera;
  }
  EXPECT_GT(of_shirts, 0);
  EXPECT_LT(of_shirts, options.cameras);
}

int MisledCameras(int cameras, double share, std::uint64_t seed) {
  SimulatedStudioOptions options = SmallRoom();
  options.cameras = cameras;
  options.misled_share = share;
  options.seed = seed;
  const Scene scene(options);
  int misled = 0;
  for (int camera = 0; camera < cameras; ++camera)
    misled += scene.StyleOf(camera).hidden != HiddenClothes::kNone;
  return misled;
}

TEST(MisledCameras, AreAsManyAsAskedRoundedUp) {
  EXPECT_EQ(MisledCameras(6, 0, 1), 0);
  EXPECT_EQ(MisledCameras(6, 0.01, 1), 1);
  EXPECT_EQ(MisledCameras(6, 0.5, 2), 3);
  EXPECT_EQ(MisledCameras(50, 0.14, 3), 7);
  EXPECT_EQ(MisledCameras(5, 1, 4), 5);
}

TEST(SimulatedStudio, RefusesContrastsAndSharesThatCannotBe) {
  for (const double contrast : {-1.0, 4.9, 100.1, std::nan("")}) {
    SimulatedStudioOptions options = SmallRoom();
    options.contrast = contrast;
    EXPECT_THROW(SimulatedStudio{options}, SetupError) << contrast;
  }
  for (const double share : {-0.1, 1.1, std::nan("")}) {
    SimulatedStudioOptions options = SmallRoom();
    options.misled_share = share;
    EXPECT_THROW(SimulatedStudio{options}, SetupError) << share;
  }
}

}  // namespace
}  // namespace mocap::simulation
