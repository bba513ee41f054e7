#include "tools/calibration/wand.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "tests/tools/calibration/simulated_board.h"
#include "tools/calibration/extrinsics.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

constexpr double kLength_mm = 500;

std::optional<Vector2> PixelOf(const CameraCalibration& camera, const Vector3& p_W) {
  const Vector3 p_C = camera.X_CW * p_W;
  const auto pixel = PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
  const bool seen = p_C.z() > 0 && pixel && pixel->minCoeff() >= 0 &&
                    pixel->x() < camera.width_px && pixel->y() < camera.height_px;
  return seen ? pixel : std::nullopt;
}

/// A wand that is waved through the room; its ends come in either order.
BoardDetections WaveWand(const std::vector<CameraCalibration>& cameras, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  std::normal_distribution<double> noise(0, 0.2);
  BoardDetections detections =
      testing::DetectionsFor(cameras, {BoardKind::kWand, 2, 1, kLength_mm, "", 0, false});
  detections.moments = 150;
  for (int m = 0; m < detections.moments; ++m) {
    const Vector3 middle(1500 * u(random), 1500 * u(random), 1100 + 900 * u(random));
    const Vector3 half = kLength_mm / 2 * Vector3(u(random), u(random), u(random)).normalized();
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      const auto p = PixelOf(cameras[c], middle - half), q = PixelOf(cameras[c], middle + half);
      if (!p || !q) continue;
      BoardDetection s;
      s.camera = static_cast<int>(c);
      s.moment = m;
      s.corners = {{0, 1}, {*p, *q}};
      for (Vector2& pixel : s.corners.pixels) pixel += Vector2(noise(random), noise(random));
      if (u(random) > 0) std::swap(s.corners.pixels[0], s.corners.pixels[1]);
      detections.detections.push_back(s);
    }
  }
  return detections;
}

TEST(WandTest, PosesAllCamerasWhoeverEndIsWhich) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const std::vector<CameraCalibration> truth = testing::SeededRig(seed);
    const StudioFit fit = FitExtrinsics(WaveWand(truth, seed), truth, {.refine_lenses = false});
    EXPECT_NEAR(fit.rms_px, 0.2 * std::sqrt(2.0), 0.05);
    // Found in the frame of the first camera.
    const RigidTransform& X_CW = truth[0].X_CW;
    for (std::size_t c = 1; c < truth.size(); ++c) {
      const Vector3 off =
          X_CW.Inverse() * fit.bundle.cameras[c].X_CW.Inverse().p - truth[c].X_CW.Inverse().p;
      EXPECT_LT(off.norm(), 5) << "seed " << seed << " " << truth[c].name;
    }
  }
}

TEST(WandTest, NamesTheCameraThatSharesNoViews) {
  const std::vector<CameraCalibration> truth = testing::SeededRig(4);
  BoardDetections detections = WaveWand(truth, 4);
  for (BoardDetection& s : detections.detections) {
    if (s.camera == 2) s.moment += detections.moments;
  }
  detections.moments *= 2;
  try {
    FitExtrinsics(detections, truth, {.refine_lenses = false});
    FAIL() << "accepted";
  } catch (const SetupError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cam3"));
  }
}

void Light(Image<Bgr>& image, const Vector2& at) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const double glow = 230 * std::exp(-(Vector2(x, y) - at).squaredNorm() / 8);
      const auto value = static_cast<std::uint8_t>(std::min(255.0, image(x, y).g + glow));
      image(x, y) = {value, value, value};
    }
  }
}

TEST(WandTest, FindsLightsToAFractionOfAPixelAndLeavesLampsOut) {
  const Vector2 lamp(50, 40);
  std::vector<BoardDetection> detections;
  std::vector<Vector2> truth;
  for (int i = 0; i < 20; ++i) {
    Image<Bgr> image(320, 240, Bgr{30, 30, 30});
    // A window is bright, but no spot.
    for (int y = 0; y < 60; ++y) std::fill_n(image.row(y) + 200, 100, Bgr{250, 250, 250});
    truth.push_back({60.3 + 7.1 * i, 120.7 + 2.2 * i});
    for (const Vector2& at : {lamp, truth.back(), Vector2(truth.back() + Vector2(50, -20))})
      Light(image, at);
    BoardDetection& s = detections.emplace_back();
    s.moment = i;
    s.corners.pixels = FindSpots(image.view());
    if (i % 2 == 0) std::reverse(s.corners.pixels.begin(), s.corners.pixels.end());
  }
  KeepWands(detections);
  ASSERT_EQ(detections.size(), 20u);
  // From frame to frame the same end has the same name, whichever it is.
  const bool turned = (detections[0].corners.pixels[0] - truth[0]).norm() > 5;
  for (const BoardDetection& s : detections)
    EXPECT_LT((s.corners.pixels[turned ? 1 : 0] - truth[s.moment]).norm(), 0.2) << s.moment;
}

TEST(WandTest, IsNamedByItsLength) {
  EXPECT_EQ(ParseBoard("wand:500").square_mm, 500);
  EXPECT_EQ(ParseBoard("wand:500").corners(), 2);
  EXPECT_THROW(ParseBoard("wand:5"), SetupError);
  EXPECT_THROW(ParseBoard("wand"), SetupError);
}

}  // namespace
}  // namespace mocap
