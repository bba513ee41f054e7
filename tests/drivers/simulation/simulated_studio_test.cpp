#include "drivers/simulation/simulated_studio.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <thread>

#include "core/errors.h"
#include "drivers/virtual_studio/motions/motion.h"
#include "drivers/virtual_studio/scene.h"
#include "drivers/virtual_studio/truth.h"
#include "tests/support/pixels.h"

namespace mocap {
namespace {

using simulation::BonePoses;
using std::chrono::milliseconds;

SimulatedStudioOptions SmallStudio(const std::string& motion = "walk") {
  SimulatedStudioOptions options = RecordedSimulation();
  options.motion = motion;
  options.width_px = 320;
  options.height_px = 240;
  options.seconds = 1;
  return options;
}

Frame GrabOne(SimulatedCamera& camera) {
  Frame frame;
  EXPECT_EQ(camera.Grab(frame, milliseconds(0)), GrabStatus::kFrame);
  return frame;
}

Vector2 PixelOf(const CameraCalibration& camera, const PanTiltAngles& angles, const Vector3& p_W) {
  const Vector3 p_C = camera.PoseAt(angles) * p_W;
  return PixelFromNormalized(camera.lens, Vector2(p_C.x() / p_C.z(), p_C.y() / p_C.z()))
      .value_or(Vector2(-1e6, -1e6));
}

bool NearMask(ImageView<const std::uint8_t> mask, const Vector2& pixel, int reach) {
  const int cx = static_cast<int>(std::lround(pixel.x())),
            cy = static_cast<int>(std::lround(pixel.y()));
  for (int y = std::max(0, cy - reach); y <= std::min(mask.height() - 1, cy + reach); ++y)
    for (int x = std::max(0, cx - reach); x <= std::min(mask.width() - 1, cx + reach); ++x)
      if (mask(x, y) != 0) return true;
  return false;
}

TEST(SimulatedStudio, TheSameSeedGivesTheSamePictures) {
  const auto third_picture = [](std::uint64_t seed) {
    SimulatedStudioOptions options = SmallStudio();
    options.seed = seed;
    const SimulatedStudio studio(options);
    const auto camera = studio.OpenCamera(2);
    camera->Start();
    GrabOne(*camera);
    GrabOne(*camera);
    return Pixels(GrabOne(*camera).image);
  };
  EXPECT_EQ(third_picture(5), third_picture(5));
  EXPECT_NE(third_picture(5), third_picture(6));
}

// The canvas is repaired, not redrawn, from frame to frame.
TEST(SimulatedStudio, APictureDoesNotDependOnThoseBefore) {
  const SimulatedStudio studio(SmallStudio("run"));
  const auto steady = studio.OpenCamera(1);
  steady->Start();
  Frame last;
  for (int i = 0; i < 20; ++i) last = GrabOne(*steady);
  simulation::ScenePainter painter(std::make_shared<const simulation::SceneView>(
      std::make_shared<const simulation::Scene>(SmallStudio("run")), 1));
  painter.Paint(last.capture_ns);
  EXPECT_EQ(Pixels(last.image), Pixels(painter.picture().view()));
}

TEST(SimulatedStudio, CamerasAgreeOnTimeWithinTheirJitter) {
  const SimulatedStudio studio(SmallStudio());
  std::vector<std::unique_ptr<SimulatedCamera>> cameras;
  for (int i = 0; i < 6; ++i) {
    cameras.push_back(studio.OpenCamera(i));
    cameras.back()->Start();
  }
  std::set<std::int64_t> offsets;
  for (int frame = 0; frame < 5; ++frame)
    for (auto& camera : cameras) {
      const Frame f = GrabOne(*camera);
      EXPECT_EQ(f.sequence, static_cast<std::uint64_t>(frame));
      const std::int64_t offset = f.capture_ns - studio.NominalTime(frame);
      EXPECT_LE(std::abs(offset), 300'000);
      offsets.insert(offset);
    }
  EXPECT_EQ(offsets.size(), 30u);
  EXPECT_EQ(studio.NominalTime(0), 1'000'000'000'000);
  EXPECT_EQ(studio.NominalTime(30), 1'001'000'000'000);
}

TEST(SimulatedStudio, CamerasInThreadsOfTheirOwnGiveTheSamePictures) {
  constexpr int kCameras = 6;
  const auto last_of_three = [](SimulatedCamera& camera) {
    camera.Start();
    GrabOne(camera);
    GrabOne(camera);
    return Pixels(GrabOne(camera).image);
  };
  SimulatedStudioOptions options = SmallStudio("dance");
  options.people = 3;
  const SimulatedStudio serial(options), threaded(options);
  std::array<std::vector<Bgr>, kCameras> pictures;
  std::vector<std::thread> threads;
  for (int c = 0; c < kCameras; ++c)
    threads.emplace_back([&, c] {
      const auto camera = threaded.OpenCamera(c);
      threaded.Background(c);
      pictures[c] = last_of_three(*camera);
    });
  for (std::thread& thread : threads) thread.join();
  for (int c = 0; c < kCameras; ++c) EXPECT_EQ(last_of_three(*serial.OpenCamera(c)), pictures[c]);
}

TEST(SimulatedStudio, EndsAfterItsSeconds) {
  SimulatedStudioOptions options = SmallStudio();
  options.seconds = 0.2;
  const SimulatedStudio studio(options);
  const auto camera = studio.OpenCamera(0);
  camera->Start();
  for (int i = 0; i < 6; ++i) GrabOne(*camera);
  Frame frame;
  EXPECT_EQ(camera->Grab(frame, milliseconds(0)), GrabStatus::kEnd);
}

struct Scenario {
  const char* motion;
  int people;
};

class TruthInPictures : public ::testing::TestWithParam<Scenario> {};
INSTANTIATE_TEST_SUITE_P(Simulated, TruthInPictures,
                         ::testing::Values(Scenario{"walk", 1}, Scenario{"run", 1},
                                           Scenario{"jump", 1}, Scenario{"dance", 1},
                                           Scenario{"stand", 1}, Scenario{"walk", 3},
                                           Scenario{"dance", 4}, Scenario{"meet", 2}),
                         [](const auto& scenario) {
                           return scenario.param.motion + std::to_string(scenario.param.people);
                         });

TEST_P(TruthInPictures, TrueJointsLieInTheTrueMask) {
  SimulatedStudioOptions options = SmallStudio(GetParam().motion);
  options.people = GetParam().people;
  options.fps = 4;
  options.seconds = 2;
  const SimulatedStudio studio(options);
  const SimulatedTruth truth(options);
  for (int c = 0; c < 6; ++c) {
    const auto camera = studio.OpenCamera(c);
    camera->Start();
    for (int i = 0; i < 8; ++i) {
      const Frame frame = GrabOne(*camera);
      for (int person = 0; person < options.people; ++person) {
        const JointPositions joints = truth.At(frame.capture_ns, person);
        for (std::size_t k = 0; k < joints.size(); ++k) {
          const Vector2 pixel = PixelOf(studio.cameras()[c], frame.angles, joints[k]);
          const bool inside =
              pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < 320 && pixel.y() < 240;
          if (!inside) continue;
          EXPECT_TRUE(NearMask(camera->TrueMask(), pixel, 1))
              << kSimulatedJointNames[k] << " in cam" << c + 1 << ", frame " << i << ", person "
              << person;
        }
      }
    }
  }
}

TEST(SimulatedStudio, TheMaskIsTheProjectedSkin) {
  SimulatedStudioOptions options = SmallStudio("stand");
  options.width_px = 640;
  options.height_px = 480;
  const auto scene = std::make_shared<const simulation::Scene>(options);
  for (int c = 0; c < 6; ++c) {
    simulation::ScenePainter painter(std::make_shared<const simulation::SceneView>(scene, c));
    painter.Paint(options.start_ns);
    std::vector<Eigen::Vector3f> p_W, n_W;
    simulation::SkinMesh(scene->figures().front().mesh,
                         scene->people().front().BonesAt(options.start_ns), p_W, n_W);
    Image<std::uint8_t> near_skin(640, 480);
    for (const Eigen::Vector3f& p : p_W) {
      const Vector2 pixel = PixelOf(scene->cameras()[c], {}, p.cast<double>());
      EXPECT_TRUE(NearMask(painter.figures().view(), pixel, 1));
      const int x = static_cast<int>(pixel.x()), y = static_cast<int>(pixel.y());
      for (int j = std::max(0, y - 8); j < std::min(480, y + 9); ++j)
        for (int i = std::max(0, x - 8); i < std::min(640, x + 9); ++i) near_skin(i, j) = 1;
    }
    for (int y = 0; y < 480; ++y)
      for (int x = 0; x < 640; ++x)
        if (painter.figures()(x, y) != 0) {
          ASSERT_EQ(near_skin(x, y), 1) << x << ' ' << y;
        }
  }
}

TEST(SimulatedStudio, APictureDiffersFromTheBackgroundWhereThePersonIs) {
  const SimulatedStudio studio(SmallStudio());
  const auto camera = studio.OpenCamera(0);
  camera->Start();
  const Frame frame = GrabOne(*camera);
  const std::vector<BackgroundFrame> background = studio.Background(0);
  ASSERT_EQ(background.size(), 40u);
  double inside = 0, outside = 0;
  int pixels_inside = 0;
  const auto mask = camera->TrueMask();
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      const double difference = std::abs(frame.image(x, y).g - background[0].image(x, y).g);
      if (mask(x, y) != 0) {
        inside += difference;
        ++pixels_inside;
      } else {
        outside += difference;
      }
    }
  ASSERT_GT(pixels_inside, 300);
  EXPECT_GT(inside / pixels_inside, 15);
  EXPECT_LT(outside / (320 * 240 - pixels_inside), 5);
}

TEST(SimulatedStudio, BackgroundFramesDifferByNoiseOnly) {
  const SimulatedStudio studio(SmallStudio());
  const std::vector<BackgroundFrame> frames = studio.Background(3);
  EXPECT_NE(frames[0].image.pixels(), frames[1].image.pixels());
  double sum = 0;
  for (std::size_t i = 0; i < frames[0].image.pixels().size(); ++i)
    sum += std::abs(frames[0].image.pixels()[i].r - frames[1].image.pixels()[i].r);
  const double mean = sum / static_cast<double>(frames[0].image.pixels().size());
  EXPECT_GT(mean, 1);
  EXPECT_LT(mean, 5);
}

TEST(SimulatedStudio, AVisitorIsNotSeenBeforeAndAfterTheVisit) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    SimulatedStudioOptions options = SmallStudio("visit");
    options.seed = seed;
    options.cameras = 8;
    const auto scene = std::make_shared<const simulation::Scene>(options);
    const auto seen = [&](int camera, double t_s) {
      simulation::ScenePainter painter(
          std::make_shared<const simulation::SceneView>(scene, camera));
      painter.Paint(options.start_ns + static_cast<std::int64_t>(t_s * 1e9));
      const auto& pixels = painter.figures().pixels();
      return std::any_of(pixels.begin(), pixels.end(), [](std::uint8_t m) { return m != 0; });
    };
    for (int c = 0; c < options.cameras; ++c) {
      EXPECT_FALSE(seen(c, 0.5)) << "seed " << seed << " cam" << c + 1;
      EXPECT_TRUE(seen(c, 9.5)) << "seed " << seed << " cam" << c + 1;
    }
  }
}

TEST(SimulatedStudio, HeadsFollowThePersonAndBackgroundsCoverWhereTheyPoint) {
  SimulatedStudioOptions options = SmallStudio();
  options.width_px = 64;
  options.height_px = 48;
  options.pan_tilt = true;
  options.fps = 5;
  options.seconds = 3;
  const SimulatedStudio studio(options);
  const SimulatedTruth truth(options);
  for (const int c : {0, 3}) {
    const auto camera = studio.OpenCamera(c);
    camera->Start();
    const std::vector<BackgroundFrame> sweep = studio.Background(c);
    for (int i = 0; i < 15; ++i) {
      const Frame frame = GrabOne(*camera);
      const JointPositions joints = truth.At(frame.capture_ns);
      const Vector3 trunk = (joints[0] + joints[1]) / 2;
      const Vector2 pixel = PixelOf(studio.cameras()[c], frame.angles, trunk);
      EXPECT_NEAR(pixel.x(), 32, 8);
      EXPECT_NEAR(pixel.y(), 24, 6);
      EXPECT_TRUE(NearMask(camera->TrueMask(), pixel, 0));
      // Within a fifth of the field of view of some background frame.
      double nearest = 1;
      for (const BackgroundFrame& b : sweep)
        nearest = std::min(nearest, std::hypot(b.angles.pan_rad - frame.angles.pan_rad,
                                               b.angles.tilt_rad - frame.angles.tilt_rad));
      EXPECT_LT(nearest, 0.15);
    }
  }
}

TEST(SimulatedStudio, InRealTimeNoFrameComesBeforeItsTimeOrTwice) {
  SimulatedStudioOptions options = SmallStudio();
  options.width_px = 64;
  options.height_px = 48;
  options.start_ns = 0;
  options.realtime = true;
  options.fps = 200;
  const SimulatedStudio studio(options);
  const auto camera = studio.OpenCamera(0);
  camera->Start();
  std::int64_t last_ns = 0;
  std::uint64_t last_sequence = 0;
  int frames = 0;
  while (frames < 20) {
    Frame frame;
    const GrabStatus status = camera->Grab(frame, milliseconds(1));
    if (status == GrabStatus::kTimeout) continue;
    ASSERT_EQ(status, GrabStatus::kFrame);
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    EXPECT_LE(frame.capture_ns, std::chrono::nanoseconds(now).count());
    EXPECT_GT(frame.capture_ns, last_ns);
    if (frames > 0) {
      EXPECT_GT(frame.sequence, last_sequence);
    }
    last_ns = frame.capture_ns;
    last_sequence = frame.sequence;
    ++frames;
  }
}

TEST(SimulatedStudio, TheTruthOfACaptureTimeIsKnownWithoutTheStudio) {
  SimulatedStudioOptions options = SmallStudio();
  options.start_ns = 0;
  options.realtime = true;
  const SimulatedTruth truth(options), elsewhere(options);
  const std::int64_t today_ns = 1'760'000'000'123'456'789;
  const JointPositions a = truth.At(today_ns), b = elsewhere.At(today_ns);
  const JointPositions next = truth.At(today_ns + 10'000'000);
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k], b[k]);
    EXPECT_LT((next[k] - a[k]).norm(), 100);
    EXPECT_LT(a[k].norm(), 4000);
  }
  EXPECT_GT((next[0] - a[0]).norm(), 1);
}

TEST(SimulatedStudio, TrueSizesAreThoseOfTheTrueJoints) {
  const SimulatedStudioOptions options = SmallStudio("stand");
  const SimulatedTruth truth(options);
  const TruthSizes sizes = truth.Sizes();
  const JointPositions p = truth.At(options.start_ns);
  const auto length = [&](simulation::TruthPoint a, simulation::TruthPoint b) {
    return (p[static_cast<int>(a)] - p[static_cast<int>(b)]).norm();
  };
  using enum simulation::TruthPoint;
  const std::vector<double> expected = {length(kPelvis, kNeck), length(kHipL, kKneeL),
                                        length(kKneeL, kAnkleL) + sizes.ankle_to_sole_mm,
                                        length(kShoulderL, kElbowL),
                                        length(kElbowL, kWristL) + length(kWristL, kFingertipsL)};
  ASSERT_EQ(sizes.lengths_mm.size(), expected.size());
  const std::vector<std::string> names = {"torso_mm", "thigh_mm", "calf_mm", "upper_arm_mm",
                                          "lower_arm_mm"};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(sizes.lengths_mm[i].first, names[i]);
    EXPECT_NEAR(sizes.lengths_mm[i].second, expected[i], i == 0 ? 3 : 1e-6) << names[i];
  }
  EXPECT_EQ(sizes.stature_mm, options.stature_mm);
}

TEST(SimulatedStudio, OpensAsAnyOtherStudio) {
  SimulatedStudioOptions options = SmallStudio();
  options.cameras = 4;
  const Studio studio = OpenSimulatedStudio(options);
  ASSERT_EQ(studio.cameras.size(), 4u);
  EXPECT_EQ(studio.fps_nominal, 30);
  EXPECT_EQ(studio.cameras[3].calibration.name, "cam4");
  EXPECT_EQ(studio.cameras[0].background().size(), 40u);
  studio.cameras[0].driver->Start();
  Frame frame;
  ASSERT_EQ(studio.cameras[0].driver->Grab(frame, milliseconds(0)), GrabStatus::kFrame);
  EXPECT_EQ(frame.image.width(), 320);
  studio.cameras[0].driver->Stop();
}

TEST(SimulatedStudio, OptionsThatCannotBeAreRefused) {
  const auto refused = [](auto change) {
    SimulatedStudioOptions options = SmallStudio();
    change(options);
    EXPECT_THROW(SimulatedStudio{options}, SetupError);
    EXPECT_THROW(OpenSimulatedStudio(options), SetupError);
  };
  refused([](auto& o) { o.motion = "fly"; });
  refused([](auto& o) { o.people = 0; });
  refused([](auto& o) { o.people = 5; });
  refused([](auto& o) { o.motion = "meet"; });
  refused([](auto& o) { o.begin_s = -1; });
  refused([](auto& o) { o.stature_mm = 300; });
  refused([](auto& o) { o.stature_mm = std::numeric_limits<double>::quiet_NaN(); });
  refused([](auto& o) { o.fps = 0; });
  refused([](auto& o) { o.cameras = 0; });
  refused([](auto& o) { o.width_px = -1; });
  refused([](auto& o) { o.seconds = -1; });
}

}  // namespace
}  // namespace mocap
